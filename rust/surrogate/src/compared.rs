//! Ranges of the beds by which the default models were compared with DEM. Beyond them nothing is known of a model's error.
//!
//! `compared.json` is made by `cases/beds/make` from the results of DEM in `cases/scenes` and `cases/beds`.
//!
//! | quantity | of | least | largest |
//! |---|---|---|---|
//! | `reduced_pressure` | p over E r/ℓ of discs, over E* of spheres | mean over the bed | at any place |
//! | `thermal_strain` | growth of the radii since the start | at any place | at any place |
//! | `temperature` \[K\] | spheres | at any place | at any place |
//! | `heat_source` \[W/m³\] | heat from inside | 0 | 0: none was compared |
//! | `conductivity_ratio` | k of spheres over that of the gas | | |
//! | `grains_across` | least distance between walls over the mean diameter | | |

use crate::models::{BUILTIN, builtin};
use crate::spheres::model::SphereModel;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// Least and largest value by the name of the quantity.
pub type Ranges = BTreeMap<String, [f64; 2]>;

/// The ranges of both kinds of grains.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Compared {
    pub discs: Ranges,
    pub spheres: Ranges,
}

/// The default models by the hash of their files, each with its ranges.
static SHIPPED: LazyLock<BTreeMap<String, Ranges>> = LazyLock::new(|| {
    let Compared { discs, spheres } = serde_json::from_str(include_str!("compared.json"))
        .expect("rust/surrogate/src/compared.json has ranges");
    let of_discs = builtin(BUILTIN).ok().map(|model| (model.hash().to_string(), discs));
    let of_spheres = SphereModel::builtin().ok().map(|model| (model.hash().to_string(), spheres));
    of_discs.into_iter().chain(of_spheres).collect()
});

/// The ranges of the model whose file has this SHA-256; `None` for a model that was not compared.
pub fn ranges(hash: &str) -> Option<&'static Ranges> {
    SHIPPED.get(hash)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_models_have_ranges_and_no_others() {
        let discs = ranges(builtin("builtin").unwrap().hash()).unwrap();
        let spheres = ranges(SphereModel::builtin().unwrap().hash()).unwrap();
        for all in [discs, spheres] {
            assert!(all.values().all(|[least, most]| least <= most), "{all:?}");
            assert_eq!(all["heat_source"], [0.0, 0.0]);
        }
        // Steel of 210 GPa at 10 to 250 kPa, and what no bed had.
        let [least, most] = spheres["reduced_pressure"];
        assert!(least < 1e4 / 1.15e11 * 1.1 && most > 2.4e5 / 1.15e11 && most < 1e-5);
        assert!(!discs.contains_key("temperature") && spheres["temperature"][1] < 400.0);
        assert_eq!(ranges(builtin("builtin:paper").unwrap().hash()), None);
        assert_eq!(ranges(""), None);
    }
}
