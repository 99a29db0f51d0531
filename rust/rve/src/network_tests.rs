//! Small networks solved by hand, and laws that every solution obeys.

use super::*;
use crate::region::{RegionKind, region};
use crate::{Averages, Compression, PackingSpec, homogenise, homogenise_in, pack};
use msdd_dem::heat::chord;
use msdd_dem::{Disc, Material, Walls};

const R: f64 = 5e-3;
const SPACING: f64 = 1.96 * R;

fn link(i: usize, j: usize, branch: [f64; 2], conductance: f64) -> Link {
    Link { i, j, branch, conductance, share: 1.0 }
}

fn close(value: f64, expected: f64) {
    assert!((value - expected).abs() < 1e-12 * expected.abs().max(1.0), "{value} {expected}");
}

/// Two chains side by side, each of unequal resistors in series between fixed ends.
#[test]
fn series_and_parallel() {
    let conductances = [[1.0, 2.0, 0.5], [3.0, 0.25, 4.0]];
    let mut links = Vec::new();
    for (chain, list) in conductances.iter().enumerate() {
        links.extend(
            list.iter().enumerate().map(|(k, &g)| link(4 * chain + k, 4 * chain + k + 1, [0.1, 0.0], g)),
        );
    }
    let network = Network { links, free: vec![1, 2, 5, 6] };
    // Length 0.3, height 0.2: K = L/H Σ g, with g the conductance of each chain.
    let series = |g: [f64; 3]| 1.0 / g.iter().map(|g| 1.0 / g).sum::<f64>();
    let [xx, yy, xy] = network.conductivity(0.3 * 0.2);
    close(xx, 0.3 / 0.2 * conductances.map(series).iter().sum::<f64>());
    assert_eq!((yy, xy), (0.0, 0.0));
}

/// Two discs in a periodic cell: unequal resistors along x, contacts with their own images along y. No temperature is
/// fixed.
#[test]
fn periodic_cell() {
    let (d, g) = (0.1, [1.0, 3.0]);
    let links = vec![
        link(0, 1, [d, 0.0], g[0]),
        link(1, 0, [d, 0.0], g[1]),
        link(0, 0, [0.0, d], 1.5),
        link(1, 1, [0.0, d], 2.5),
    ];
    let [xx, yy, xy] = Network { links, free: vec![0, 1] }.conductivity(2.0 * d * d);
    close(xx, 2.0 * g[0] * g[1] / (g[0] + g[1]));
    close(yy, 2.0);
    close(xy, 0.0);
}

/// 12 × 12 discs on a lattice; with `walls` the square one touches its walls.
fn lattice(a: [f64; 2], b: [f64; 2], walls: bool) -> Simulation {
    let places = (0..144).map(|k| (f64::from(k / 12) + 0.5, f64::from(k % 12) + 0.5));
    let discs = places.map(|(k, l)| Disc::at_rest(k * a[0] + l * b[0], k * a[1] + l * b[1], R, 3000.0));
    let size = 12.0 * SPACING;
    let position = if walls { [0.0, size, 0.0, size] } else { [-1.0, 1.0, -1.0, 1.0] };
    let walls = Walls { position, ..Walls::around(1.0, 1.0) };
    Simulation::new(Material::default(), discs.collect(), walls)
}

fn assert_network_is_affine(a: &Averages) {
    assert!(a.conductivity_xx > 0.1);
    close(a.conductivity_network_xx, a.conductivity_xx);
    close(a.conductivity_network_yy, a.conductivity_yy);
    close(a.conductivity_network_xy, a.conductivity_xy);
}

/// In a lattice the heat of every disc is in balance by symmetry: T′ = 0.
#[test]
fn lattices_are_affine() {
    let d = SPACING;
    let square = lattice([d, 0.0], [0.0, d], true);
    let hexagonal = lattice([d, 0.0], [-0.5 * d, 0.75f64.sqrt() * d], false);
    for kind in [RegionKind::Hull, RegionKind::Inset] {
        for cut in [Cut::Clip, Cut::Whole] {
            assert_network_is_affine(&homogenise_in(&square, &region(&square, kind), cut));
        }
    }
    let window = Polygon::rectangle([3.3 * d, 3.3 * d], [7.3 * d, 7.3 * d]);
    assert_network_is_affine(&homogenise_in(&square, &window, Cut::Clip));
    let window = Polygon::rectangle([2.1 * d, 3.3 * d], [5.1 * d, 6.8 * d]);
    assert_network_is_affine(&homogenise_in(&hexagonal, &window, Cut::Clip));
}

/// A disc between four neighbours, the left of which is larger. With T = ∓d left and right and 0 above and below,
/// a (−d − T′) + b (d − T′) − 2 b T′ = 0.
#[test]
fn defect_in_a_lattice() {
    let (d, large) = (SPACING, 1.04 * R);
    let discs = [(0.0, 0.0, R), (-d, 0.0, large), (d, 0.0, R), (0.0, d, R), (0.0, -d, R)];
    let discs = discs.map(|(x, y, r)| Disc::at_rest(x, y, r, 3000.0)).to_vec();
    let walls = Walls { position: [-1.0, 1.0, -1.0, 1.0], ..Walls::around(1.0, 1.0) };
    let simulation = Simulation::new(Material::default(), discs, walls);
    let region = Polygon::rectangle([-0.5 * d, -0.5 * d], [0.5 * d, 0.5 * d]);
    let averages = homogenise_in(&simulation, &region, Cut::Clip);
    let (a, b) = (chord([R, large], d) / d, chord([R, R], d) / d);
    let fluctuation = d * (b - a) / (a + 3.0 * b);
    assert!(fluctuation.abs() > 1e-2 * d);
    // Half of each branch lies inside the region.
    close(averages.conductivity_network_xx, 0.5 * (a * (d + fluctuation) + b * (d - fluctuation)) / d);
    close(averages.conductivity_network_yy, b);
    close(averages.conductivity_network_xy, 0.0);
}

fn packed(compression: Compression, seed: u64) -> Simulation {
    let spec = PackingSpec { discs: 150, seed, porosity: 0.13, compression, ..PackingSpec::default() };
    pack(&spec, &Material::default()).unwrap().simulation
}

#[test]
fn packings_conduct_less_than_affine() {
    for (compression, seed) in [(Compression::Isotropic, 1), (Compression::Horizontal, 2)] {
        let state = packed(compression, seed);
        for kind in [RegionKind::Hull, RegionKind::Inset] {
            let a = homogenise(&state, kind);
            for (network, affine) in [
                (a.conductivity_network_xx, a.conductivity_xx),
                (a.conductivity_network_yy, a.conductivity_yy),
            ] {
                assert!((0.9..0.995).contains(&(network / affine)), "{network} {affine}");
            }
            let size = (a.conductivity_network_xx * a.conductivity_network_yy).sqrt();
            assert!(a.conductivity_network_xy.abs() < 0.1 * size);
        }
    }
}

/// The heat of every free disc is in balance. When every branch counts whole, the work of the mean flux on the mean
/// gradient equals the sum over the contacts: Σ g (d + ΔT′)² = Σ g (d + ΔT′) d, which makes K symmetric.
#[test]
fn balance_and_work() {
    let state = packed(Compression::Horizontal, 2);
    let mut network = Network::of_region(&state, &region(&state, RegionKind::Hull), Cut::Clip);
    network.links.iter_mut().for_each(|link| link.share = 1.0);
    let fluctuation = network.fluctuations();
    let mut balance = vec![[0.0f64; 2]; state.discs.len()];
    let mut sums = [[[0.0f64; 2]; 2]; 2];
    for link in &network.links {
        let (i, j) = (fluctuation(link.i), fluctuation(link.j));
        let drop = [0, 1].map(|a| link.branch[a] + j[a] - i[a]);
        for a in 0..2 {
            balance[link.i][a] += link.conductance * drop[a];
            balance[link.j][a] -= link.conductance * drop[a];
            for b in 0..2 {
                sums[0][a][b] += link.conductance * drop[a] * drop[b];
                sums[1][a][b] += link.conductance * drop[a] * link.branch[b];
            }
        }
    }
    let scale = sums[0][0][0];
    for &disc in &network.free {
        assert!(balance[disc].iter().all(|b| b.abs() < 1e-12), "{disc}: {:?}", balance[disc]);
    }
    for (a, b) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        assert!((sums[0][a][b] - sums[1][a][b]).abs() < 1e-11 * scale, "{sums:?}");
    }
}

/// A lone disc, an isolated pair and a box without contacts: all results are finite, and the isolated pair conducts
/// nothing.
#[test]
fn loose_discs_carry_nothing() {
    let walls = Walls::around(1.0, 1.0);
    let at = |places: &[(f64, f64)]| {
        let discs = places.iter().map(|&(x, y)| Disc::at_rest(x, y, R, 3000.0)).collect();
        let averages =
            homogenise(&Simulation::new(Material::default(), discs, walls.clone()), RegionKind::Inset);
        [averages.conductivity_network_xx, averages.conductivity_network_yy, averages.conductivity_network_xy]
    };
    assert_eq!(at(&[(0.2, 0.2), (0.7, 0.7)]), [0.0; 3]);
    for value in at(&[(0.2, 0.2), (0.2 + SPACING, 0.21), (0.7, 0.7)]) {
        assert!(value.abs() < 1e-15, "{value}");
    }
    // A packing contracted until it is unjammed conducts less than before, and no result is NaN.
    let jammed = packed(Compression::Isotropic, 1);
    let mut loose = jammed.discs.clone();
    loose.iter_mut().for_each(|disc| disc.radius *= 0.9);
    let loose = Simulation::new(Material::default(), loose, jammed.walls.clone());
    let [before, after] = [&jammed, &loose].map(|s| homogenise(s, RegionKind::Hull).conductivity_network_xx);
    assert!((0.0..0.05 * before).contains(&after.abs()), "{after} {before}");
}
