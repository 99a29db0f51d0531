//! The committed runs by DEM of `cases/reference`, three packings for each case. The solver is compared with
//! them.

use crate::ReferenceError;
use crate::results::{Results, Table};
use std::path::Path;

/// Seeds of the packings of the reference.
pub const SEEDS: [u32; 3] = [1, 2, 3];
/// Folders and names of the cases; in those with a star the grains do not expand.
pub const CASES: [(&str, &str); 6] =
    [("H", "H"), ("C", "C"), ("HC", "HC"), ("Hstar", "H*"), ("Cstar", "C*"), ("HCstar", "HC*")];
/// Conductivity of the grains in the cases [W/(m K)], by which the reference's K/k is multiplied.
pub const GRAIN_CONDUCTIVITY: f64 = 100.0;

/// Range of the temperature in a case \[K\]; errors are given in per cent of it.
pub fn temperature_range(case: &str) -> f64 {
    if case.starts_with("HC") { 100.0 } else { 50.0 }
}

/// The paper's range of the pressure \[Pa\]; errors are given in per cent of it (section 3.3).
pub fn pressure_range(case: &str) -> f64 {
    match case.trim_end_matches("star") {
        "H" => 3200.0,
        "C" => 2200.0,
        _ => 3800.0,
    }
}

/// Results of one case by DEM, one for each packing.
#[derive(Clone)]
pub struct Reference {
    pub case: String,
    pub results: Vec<Results>,
}

impl Reference {
    /// Reads `cases/reference/results/<case>_seed<N>.json`.
    ///
    /// # Errors
    /// [`ReferenceError::File`], [`ReferenceError::Read`].
    pub fn read(checkout: &Path, case: &str, seeds: &[u32]) -> Result<Self, ReferenceError> {
        let read = |seed: &u32| {
            Results::read(&checkout.join(format!("cases/reference/results/{case}_seed{seed}.json")))
        };
        Ok(Self { case: case.to_string(), results: seeds.iter().map(read).collect::<Result<_, _>>()? })
    }

    /// The same reference with the first packings alone.
    pub fn first(&self, packings: usize) -> Self {
        Self { case: self.case.clone(), results: self.results.iter().take(packings).cloned().collect() }
    }

    /// Times of the series \[s\], the same for all packings.
    pub fn times(&self) -> Vec<f64> {
        self.results[0].series.column("time").unwrap_or_default()
    }

    /// A column of the series, by packing.
    pub fn series(&self, column: &str) -> Vec<Vec<f64>> {
        self.results.iter().map(|r| r.series.column(column).unwrap_or_default()).collect()
    }

    /// Mean T \[K\] over 40 mm windows at P1 to P3: by probe, then by packing.
    pub fn temperature(&self) -> [Vec<Vec<f64>>; 3] {
        [1, 2, 3].map(|probe| self.series(&format!("T_P{probe}_window")))
    }

    /// A column of the 30 sub-regions at the end, by packing.
    pub fn sub_regions(&self, column: &str) -> Vec<Vec<f64>> {
        self.results.iter().map(|r| r.sub_regions_end.column(column).unwrap_or_default()).collect()
    }

    /// A column of the 30 sub-regions at the start, by packing.
    pub fn sub_regions_start(&self, column: &str) -> Vec<Vec<f64>> {
        self.results.iter().map(|r| r.sub_regions_start.column(column).unwrap_or_default()).collect()
    }

    /// Mean displacement along x of the discs that started in each sub-region \[m\], by packing; packings without it are left
    /// out.
    pub fn displacement(&self) -> Vec<Vec<f64>> {
        let tables = self.results.iter().filter_map(|r| r.displacement.as_ref());
        tables.map(|table| table.column("displacement_x").unwrap_or_default()).collect()
    }

    /// A column of the profile along x at the end in ten slices, by packing.
    pub fn slices(&self, column: &str) -> Vec<Vec<f64>> {
        self.results.iter().map(|r| last_profile(&r.profiles, column)).collect()
    }
}

/// The last of the profiles, in ten slices: pairs of its 20 bins are averaged.
fn last_profile(profiles: &Table, column: &str) -> Vec<f64> {
    let values = profiles.column(column).unwrap_or_default();
    let last = &values[values.len().saturating_sub(20)..];
    last.chunks(2).map(|pair| pair.iter().sum::<f64>() / pair.len() as f64).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_committed_reference_has_what_is_compared() {
        let checkout = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let reference = Reference::read(&checkout, "HC", &[1, 2]).unwrap();
        assert_eq!(reference.times().len(), 201);
        assert_eq!(reference.temperature()[2][1].len(), 201);
        assert_eq!(reference.sub_regions("porosity")[0].len(), 30);
        let displacement = reference.slices("displacement_x");
        assert_eq!(displacement[0].len(), 10);
        assert!(displacement[0].iter().all(|&u| u > 0.0 && u < 0.03));
    }
}
