//! Cache of the results of jobs on disk. The key of a result is a hash of everything that it depends on: the job, the files
//! that it reads, the programs, the processor.

use crate::jobs::execute::Record;
use crate::jobs::job::{CaseProgram, ENGINE, Job, Part};
use crate::{ReportError, read_text, write_text};
use sha2::{Digest, Sha256};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;

pub struct Cache {
    folder: PathBuf,
    checkout: PathBuf,
    cpu: String,
    /// Files of the solver, as [`programs`] finds them.
    programs: Vec<PathBuf>,
    /// Hashes of files and folders that were computed already; files do not change while a report is made.
    known: Mutex<HashMap<PathBuf, String>>,
}

/// Prints the files that belong to `msddFoam`, the program first, one a line.
const PROGRAMS: &str = ". scripts/foam-env && printf '%s\\n' \"$FOAM_USER_APPBIN/msddFoam\" \
    \"$FOAM_USER_LIBBIN\"/libgranular{Models,FunctionObjects}.so";

/// The files of the solver that jobs run, the program first: of the OpenFOAM that `scripts/foam-env` takes. They need not exist.
///
/// # Errors
/// [`ReportError::Start`] with what `scripts/foam-env` says.
pub fn programs(checkout: &Path) -> Result<Vec<PathBuf>, ReportError> {
    let failed = |problem: String| ReportError::Start { program: "scripts/foam-env".to_string(), problem };
    let output = Command::new("bash")
        .args(["-c", PROGRAMS])
        .current_dir(checkout)
        .output()
        .map_err(|error| failed(error.to_string()))?;
    if !output.status.success() {
        return Err(failed(String::from_utf8_lossy(&output.stderr).trim().to_string()));
    }
    Ok(String::from_utf8_lossy(&output.stdout).lines().map(PathBuf::from).collect())
}

impl Cache {
    pub fn new(folder: &Path, checkout: &Path, cpu: &str, programs: &[PathBuf]) -> Self {
        let known = Mutex::new(HashMap::new());
        Self {
            folder: folder.to_path_buf(),
            checkout: checkout.to_path_buf(),
            cpu: cpu.to_string(),
            programs: programs.to_vec(),
            known,
        }
    }

    /// The job's key: 64 hexadecimal digits.
    ///
    /// # Errors
    /// [`ReportError::Read`] for a file of the job that is missing.
    pub fn key(&self, job: &Job) -> Result<String, ReportError> {
        let mut parts = vec![format!("{job:?}"), self.cpu.clone()];
        match job {
            Job::Solver(solver) => {
                let case = format!("cases/{}", solver.case);
                for folder in ["0", "constant", "system"] {
                    parts.push(self.hash(format!("{case}/{folder}"))?);
                }
                // A case without expansion includes the files of the case with expansion.
                let whole = solver.case.trim_end_matches("star");
                parts.push(self.hash(format!("cases/{whole}/0"))?);
                parts.push(self.hash(format!("cases/{whole}/constant"))?);
                parts.push(self.hash("cases/common")?);
                if solver.part != Part::Shipped {
                    parts.push(self.hash(format!("cases/reference/fields/seed{}", solver.seed))?);
                }
                if let Some(source) = &solver.plugin {
                    parts.push(self.hash(source)?);
                }
                self.add_programs(&mut parts)?;
            }
            Job::Spheres(spheres) => {
                let case = format!("cases/{}", spheres.case);
                for folder in ["0", "constant", "system"] {
                    parts.push(self.hash(format!("{case}/{folder}"))?);
                }
                if !spheres.compare.is_empty() {
                    parts.push(self.hash(format!("{case}/dem.csv"))?);
                }
                parts.push(self.hash("cases/common")?);
                self.add_programs(&mut parts)?;
            }
            Job::Tool(tool) => {
                for input in &tool.inputs {
                    parts.push(self.hash(input)?);
                }
            }
            // The checksum of the case is part of the job.
            Job::Case(case) => match case.program {
                CaseProgram::Solver(_) => self.add_programs(&mut parts)?,
                CaseProgram::Choice(_) => {
                    self.add_programs(&mut parts)?;
                    parts.push(self.hash("rust/autotune/src")?);
                }
                CaseProgram::Discs(_) => {
                    for input in ENGINE {
                        parts.push(self.hash(input)?);
                    }
                }
            },
        }
        Ok(hex(&Sha256::digest(parts.join("\n"))))
    }

    fn add_programs(&self, parts: &mut Vec<String>) -> Result<(), ReportError> {
        for program in &self.programs {
            parts.push(self.hash(program)?);
        }
        Ok(())
    }

    /// Hash of a file, or of all files of a folder with their names, but without results and meshes.
    fn hash(&self, path: impl AsRef<Path>) -> Result<String, ReportError> {
        let path = self.checkout.join(path);
        if let Some(hash) = self.known.lock().ok().and_then(|known| known.get(&path).cloned()) {
            return Ok(hash);
        }
        let mut digest = Sha256::new();
        add(&mut digest, &path)?;
        let hash = hex(&digest.finalize());
        if let Ok(mut known) = self.known.lock() {
            known.insert(path, hash.clone());
        }
        Ok(hash)
    }

    /// The folder of the results.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    fn file(&self, key: &str) -> PathBuf {
        self.folder.join(format!("{key}.json"))
    }

    /// The job's result, if there is one. A file that cannot be read counts as none.
    pub fn get(&self, key: &str) -> Option<Record> {
        let text = read_text(&self.file(key)).ok()?;
        let record: Record = serde_json::from_str(&text).ok()?;
        Some(Record { cached: true, ..record })
    }

    /// # Errors
    /// [`ReportError::Write`].
    pub fn put(&self, key: &str, record: &Record) -> Result<(), ReportError> {
        let file = self.file(key);
        let text = serde_json::to_string(record)
            .map_err(|error| ReportError::Write { file: file.clone(), problem: error.to_string() })?;
        write_text(&file, &text)
    }
}

fn add(digest: &mut Sha256, path: &Path) -> Result<(), ReportError> {
    if path.is_dir() {
        for entry in msdd_files::list(path)? {
            let name = entry.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if name == "polyMesh" || name == "target" {
                continue;
            }
            digest.update(name.as_bytes());
            add(digest, &entry)?;
        }
        return Ok(());
    }
    let bytes = std::fs::read(path)
        .map_err(|error| ReportError::Read { file: path.to_path_buf(), problem: error.to_string() })?;
    digest.update((bytes.len() as u64).to_le_bytes());
    digest.update(bytes);
    Ok(())
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::jobs::execute::{Outcome, Stamp};
    use crate::jobs::job::ToolJob;

    fn job(limit: u64) -> Job {
        let inputs = vec!["input".to_string()];
        Job::Tool(ToolJob { arguments: vec!["bench".to_string()], inputs, output: None, limit })
    }

    #[test]
    fn the_solver_is_that_of_the_shell() {
        let checkout = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap();
        let files = programs(&checkout).unwrap();
        let names: Vec<_> = files.iter().map(|file| file.file_name().unwrap().to_str().unwrap()).collect();
        assert_eq!(names, ["msddFoam", "libgranularModels.so", "libgranularFunctionObjects.so"]);
        assert!(files.iter().all(|file| file.is_absolute()), "{files:?}");
        let error = programs(&checkout.join("rust")).unwrap_err().to_string();
        assert!(error.contains("cannot start scripts/foam-env"), "{error}");
    }

    #[test]
    fn a_result_is_found_again_until_what_decides_it_changes() {
        let folder = std::env::temp_dir().join(format!("msdd-report-cache-{}", std::process::id()));
        write_text(&folder.join("input/a"), "1").unwrap();
        let cache = || Cache::new(&folder.join("cache"), &folder, "cpu", &[]);
        let key = cache().key(&job(1)).unwrap();
        let record = Record {
            job: job(1),
            outcome: Outcome::Done,
            message: String::new(),
            cpu_seconds: 0.1,
            wall_seconds: 0.2,
            run: None,
            printed: "text".to_string(),
            file: None,
            stamp: Stamp::default(),
            cached: false,
        };
        assert!(cache().get(&key).is_none());
        let asked = [crate::jobs::pool::Asked { job: job(1), guess: 1.0 }];
        let error = crate::jobs::pool::found(&cache(), &asked).unwrap_err().to_string();
        assert!(error.contains("nothing to draw") && error.contains("cache"), "{error}");
        cache().put(&key, &record).unwrap();
        assert_eq!(cache().get(&key), Some(Record { cached: true, ..record }));
        assert_eq!(crate::jobs::pool::found(&cache(), &asked).unwrap().len(), 1);
        assert_ne!(cache().key(&job(2)).unwrap(), key);
        assert_ne!(Cache::new(&folder, &folder, "other", &[]).key(&job(1)).unwrap(), key);
        write_text(&folder.join("input/a"), "2").unwrap();
        assert_ne!(cache().key(&job(1)).unwrap(), key);
        write_text(&folder.join("cache").join(format!("{key}.json")), "{ half").unwrap();
        assert!(cache().get(&key).is_none());
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
