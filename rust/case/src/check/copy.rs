//! Copies of cases without a mesh, in which blockMesh makes it. All that it leaves as it is are links.

use crate::openfoam::{self, message};
use std::fs;
use std::path::{Path, PathBuf};

/// A copy of a case that is removed when this is dropped.
pub struct Copy(PathBuf);

impl Copy {
    pub fn folder(&self) -> &Path {
        &self.0
    }

    /// A copy with a mesh of a case that has none, but a blockMeshDict; none of other cases.
    pub fn with_mesh(case: &Path) -> Result<Option<Self>, String> {
        let missing: Vec<String> =
            regions(case).into_iter().filter(|region| has_no_mesh(case, region)).collect();
        if missing.is_empty() {
            return Ok(None);
        }
        let name =
            format!(".{}.check-{}", case.file_name().unwrap_or_default().display(), std::process::id());
        let beside = case.with_file_name(&name);
        let place = if fs::create_dir(&beside).is_ok() { beside } else { std::env::temp_dir().join(name) };
        let copy = Self(place);
        let regions: Vec<&str> = missing.iter().map(String::as_str).filter(|name| !name.is_empty()).collect();
        link(case, &copy.0, &["constant"])
            .and_then(|()| link(&case.join("constant"), &copy.0.join("constant"), &regions))
            .and_then(|()| {
                let inside = |region: &&str| Path::new("constant").join(region);
                let mut all = regions.iter().map(inside);
                all.try_for_each(|part| link(&case.join(&part), &copy.0.join(&part), &["polyMesh"]))
            })
            .map_err(|error| format!("cannot copy the case: {error}"))?;
        for region in missing {
            let mut command = openfoam::command(Path::new("blockMesh"));
            if !region.is_empty() {
                command.args(["-region", &region]);
            }
            let output = command.arg("-case").arg(&copy.0).output().map_err(|error| error.to_string())?;
            if !output.status.success() {
                let file = Path::new("system").join(region).join("blockMeshDict");
                let said = message(&String::from_utf8_lossy(&output.stderr), &copy.0);
                return Err(format!("{}: blockMesh makes no mesh of it: {said}", file.display()));
            }
        }
        Ok(Some(copy))
    }
}

impl Drop for Copy {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn names(folder: &Path) -> impl Iterator<Item = String> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    entries.filter_map(|entry| entry.file_name().into_string().ok())
}

/// Names of the regions with a blockMeshDict; that of the bed is empty.
fn regions(case: &Path) -> Vec<String> {
    let system = case.join("system");
    let all = std::iter::once(String::new()).chain(names(&system));
    all.filter(|name| system.join(name).join("blockMeshDict").is_file()).collect()
}

fn has_no_mesh(case: &Path, region: &str) -> bool {
    let mesh = case.join("constant").join(region).join("polyMesh");
    !["faces", "faces.gz"].iter().any(|name| mesh.join(name).exists())
}

/// Makes a folder with links to all that another holds, but for some names. The folder may be there, and the other one may be missing.
fn link(from: &Path, to: &Path, but: &[&str]) -> std::io::Result<()> {
    fs::create_dir_all(to)?;
    let all = names(from).filter(|name| !but.contains(&name.as_str()));
    all.into_iter().try_for_each(|name| std::os::unix::fs::symlink(from.join(&name), to.join(&name)))
}
