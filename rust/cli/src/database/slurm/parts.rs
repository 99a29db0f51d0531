//! The parts of a plan: where they are, and what of each is there.

use crate::error::CliError;
use msdd_rve::database::{Stored, planned_packings, stored};
use std::path::{Path, PathBuf};

/// The parts of one plan.
pub struct Parts {
    out: PathBuf,
    folder: PathBuf,
    count: u32,
    /// Packings of each part.
    packings: Vec<usize>,
    hash: String,
}

/// What is there.
pub struct Standing {
    /// Whether the joined database is there.
    pub complete: bool,
    parts: Vec<Option<Stored>>,
}

impl Parts {
    /// The parts of the plan (its text and file), whose joined database is to be `out`.
    pub fn new((text, plan): (&str, &Path), out: &Path, count: u32) -> Result<Self, CliError> {
        let (hash, all) = planned_packings(text, &plan.display().to_string())?;
        if count as usize > all {
            let allowed = format!("1 to {all}, the number of packings of {}", plan.display());
            return Err(CliError::Message(format!("--array {count}, allowed: {allowed}")));
        }
        let packings = (0..count as usize).map(|part| (all - part).div_ceil(count as usize)).collect();
        let absolute = |path: &Path| {
            std::path::absolute(path)
                .map_err(|error| CliError::Message(format!("{}: {error}", path.display())))
        };
        let out = absolute(out)?;
        let mut folder = out.clone().into_os_string();
        folder.push(".parts");
        let parts = Self { out, folder: PathBuf::from(folder), count, packings, hash };
        parts.refuse_others()?;
        Ok(parts)
    }

    /// Parts of another division would never be joined.
    fn refuse_others(&self) -> Result<(), CliError> {
        let names = std::fs::read_dir(&self.folder).into_iter().flatten().flatten();
        for name in names.map(|entry| entry.file_name().to_string_lossy().into_owned()) {
            let other = name.strip_suffix(".msdd").and_then(|name| name.split_once("-of-"));
            if let Some((_, other)) = other.filter(|(_, other)| *other != self.count.to_string()) {
                return Err(CliError::Message(format!(
                    "--array {}, allowed: {other}, the division of the parts in {}; remove the folder to divide anew",
                    self.count,
                    self.folder.display()
                )));
            }
        }
        Ok(())
    }

    pub fn out(&self) -> &Path {
        &self.out
    }

    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// What names the database among others: a hash (FNV-1a) of its path.
    pub fn key(&self) -> String {
        let bytes = self.out.as_os_str().as_encoded_bytes().iter();
        let hash = bytes.fold(0xcbf2_9ce4_8422_2325_u64, |hash, &byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        });
        format!("{hash:016x}")
    }

    pub fn count(&self) -> u32 {
        self.count
    }

    /// Packings of all parts.
    pub fn packings(&self) -> usize {
        self.packings.iter().sum()
    }

    /// The database of a part; `part` is its number, from 1, or what stands for it in a script.
    pub fn database(&self, part: &str) -> PathBuf {
        self.folder.join(format!("{part}-of-{}.msdd", self.count))
    }

    /// The log of a part.
    pub fn log(&self, part: &str) -> PathBuf {
        self.folder.join(format!("{part}.log"))
    }

    /// Looks at all files.
    pub fn standing(&self) -> Result<Standing, CliError> {
        let look = |path: &Path| -> Result<Option<Stored>, CliError> {
            let Some(found) = stored(path)? else { return Ok(None) };
            if found.plan_hash != self.hash {
                return Err(CliError::Message(format!(
                    "{}: belongs to another plan: choose another --out or remove the file",
                    path.display()
                )));
            }
            Ok(Some(found))
        };
        let whole = look(&self.out)?;
        let complete = whole.is_some_and(|whole| whole.complete && whole.packings == self.packings());
        let parts = (1..=self.count).map(|part| look(&self.database(&part.to_string())));
        Ok(Standing { complete, parts: parts.collect::<Result<_, _>>()? })
    }
}

impl Standing {
    /// Packings stored in all parts.
    pub fn stored(&self) -> usize {
        self.parts.iter().flatten().map(|part| part.packings).sum()
    }

    /// Packings stored in one part.
    pub fn stored_in(&self, part: u32) -> usize {
        self.parts.get(part as usize - 1).and_then(Option::as_ref).map_or(0, |part| part.packings)
    }

    /// Parts that are done.
    pub fn finished(&self) -> usize {
        self.parts.iter().flatten().filter(|part| part.complete).count()
    }

    pub fn all_finished(&self) -> bool {
        self.finished() == self.parts.len()
    }

    /// Parts that are neither done nor queued.
    pub fn missing(&self, queued: &[u32]) -> Vec<u32> {
        let done = |part: &Option<Stored>| part.as_ref().is_some_and(|part| part.complete);
        let parts = (1u32..).zip(&self.parts);
        parts
            .filter(|(number, part)| !done(part) && !queued.contains(number))
            .map(|(number, _)| number)
            .collect()
    }
}
