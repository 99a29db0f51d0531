//! Tests of the means over sub-regions, windows and profiles with discs whose values are known.

use super::*;
use msdd_dem::{Disc, Material, Walls};

/// A lattice of touching discs in a box of 0.4 m, numbered row by row.
fn lattice() -> Simulation {
    let at = |k: u32| 0.01 * (0.5 + f64::from(k));
    let disc = |k: u32| Disc::at_rest(at(k % 40), at(k / 40), 5.05e-3, 1.0);
    Simulation::new(Material::default(), (0..1600).map(disc).collect(), Walls::around(0.4, 0.4))
}

#[test]
fn displacement_belongs_to_where_a_disc_started() {
    let start = lattice();
    let centres: Vec<[f64; 2]> = start.discs.iter().map(|d| [d.x, d.y]).collect();
    let mut moved = start.clone();
    // Displaced by a tenth of their x, so that some discs end in the next sub-region.
    moved.discs.iter_mut().for_each(|d| (d.x, d.y) = (1.1 * d.x, d.y - 1e-3));
    let table = displacements(&moved, &centres);
    assert_eq!(table.rows.len(), SUB_REGIONS[0] * SUB_REGIONS[1]);
    for (k, row) in table.rows.iter().enumerate() {
        let x = 0.04 * ((k % SUB_REGIONS[0]) as f64 + 0.5);
        assert!((row[0] - x).abs() < 1e-9 && (row[2] - 0.1 * x).abs() < 1e-9, "{row:?}");
        assert!((row[3] + 1e-3).abs() < 1e-9, "{row:?}");
    }
}

#[test]
fn grains_of_a_window_at_both_times() {
    let start = lattice();
    let mut now = start.clone();
    now.discs.iter_mut().for_each(|d| (d.x, d.temperature) = (d.x + 0.1, 70.0));
    let found = grains(&start, 50.0, &now, [0.2, 0.2], 0.12);
    // 12 x 12 discs inside, and those around them that reach into the window.
    assert_eq!(found.start.rows.len(), 14 * 14);
    assert_eq!(found.end.rows.len(), 14 * 14);
    assert!(
        found.start.rows.iter().all(|row| row[4] == 50.0) && found.end.rows.iter().all(|row| row[4] == 70.0)
    );
    let number = |table: &Table| table.column("disc").unwrap()[0];
    assert_eq!(number(&found.start), number(&found.end) + 10.0, "other discs are there now");
}

#[test]
fn the_inner_box_leaves_the_walls_out() {
    let columns = series_columns(0);
    let row = series_row(&lattice(), &[], 0.04);
    let of = |name: &str| row[columns.iter().position(|column| column == name).unwrap()];
    assert_eq!(columns.len(), row.len());
    // The lattice is the same everywhere, but has no contacts with the walls, so the half branches there carry no force.
    let whole = of("stress_xx_inner") * 39.0 / 40.0;
    assert!(of("pressure_inner") > of("pressure") && (of("stress_xx") / whole - 1.0).abs() < 1e-3, "{row:?}");
}
