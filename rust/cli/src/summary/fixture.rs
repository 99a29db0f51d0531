//! Small results of six cases, for the tests of this module.

use msdd_dem_reference::packings::CASES;
use std::path::{Path, PathBuf};

/// What the solver writes at the end of a run.
pub const SOLVER: &str = r#"{
  "application": "msddFoam",
  "wall_seconds": 30.5,
  "steps": 20000,
  "cells": 3000,
  "queries": 20000,
  "clamped_queries": 7,
  "model": {"source": "builtin", "hash": "abc", "library_version": "0.1.0"},
  "final": {
    "time": 20,
    "porosity": 0.08,
    "fabric": 0.02,
    "conductivity_xx": 52,
    "conductivity_yy": 46,
    "stress_xx": 6000,
    "stress_yy": 4000,
    "pressure": 5000
  }
}
"#;

/// What OpenFOAM's probes write; one temperature lies above the hottest wall of the shipped cases.
const PROBES: &str = "# Probe 0 (0 0 0)\n#  Time\n 1 50 51 52\n 5 79 80 81\n 20 119 120 121\n";

/// The committed results by DEM.
pub fn reference() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/reference")
}

/// Six case folders with results; removed when dropped.
pub struct Cases(PathBuf);

impl Cases {
    /// Makes the folders. Every test needs another `name`, because tests run at the same time.
    pub fn new(name: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("msdd-summary-{}-{name}", std::process::id()));
        let cases = Self(folder);
        for (case, _) in CASES {
            cases.write_summary(case, SOLVER);
            let probes = cases.0.join(case).join("postProcessing/probes/0");
            std::fs::create_dir_all(&probes).unwrap();
            std::fs::write(probes.join("T"), PROBES).unwrap();
        }
        cases
    }

    pub fn path(&self) -> &Path {
        &self.0
    }

    /// Replaces the solver's summary of a case.
    pub fn write_summary(&self, case: &str, text: &str) {
        let folder = self.0.join(case).join("postProcessing/msddFoam");
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join("summary.json"), text).unwrap();
    }
}

impl Drop for Cases {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}
