//! Check of the homogenised conductivity: compared with the heat flux through the whole assembly between two walls.

use crate::network::{Link, Network, sorted_along};
use crate::window::window;
use crate::{Compression, Material, PackingSpec, Simulation, pack};
use msdd_dem::heat::conductance;
use msdd_dem::{Disc, Side, Walls};

/// Share of the length that is left out at each end, where contacts with the wall add resistance and grains are ordered
/// by the wall.
const END: f64 = 0.15;
/// Side of the windows, which are about square, in mean radii: 215 mm for the paper's grains, about 500 discs.
const WINDOW: f64 = 43.0;

/// Direction of the temperature difference.
#[derive(Clone, Copy)]
enum Axis {
    X,
    Y,
}

/// Measured and homogenised conductivity along one axis, all over k [-].
#[derive(Clone, Copy, Debug)]
struct HeatCheck {
    /// Flux over the temperature gradient in the inner part.
    k_measured: f64,
    /// Mean over windows of the inner part, affine estimate (Eq. 9).
    k_affine: f64,
    /// Mean over the same windows, with the network of contacts solved.
    k_network: f64,
    affine_over_measured: f64,
    network_over_measured: f64,
}

/// Imposes a temperature difference between the two walls of an axis, with the other two walls insulated. Compares the
/// steady flux with the conductivity homogenised in windows between the ends. For a box in which no chain of contacts
/// conducts heat, the measured value is 0.
fn heat_check(simulation: &Simulation, axis: Axis) -> HeatCheck {
    let (flux, gradient) = flux_and_gradient(simulation, axis);
    // Grains connected to one wall only take its temperature: flux and gradient are then 0 up to round-off.
    let k_measured = if gradient.abs() > 1e-9 { flux / gradient } else { 0.0 };
    let [k_affine, k_network] = inner_windows(simulation, axis);
    let ratio = |k: f64| if k_measured > 0.0 { k / k_measured } else { 0.0 };
    HeatCheck {
        k_measured,
        k_affine,
        k_network,
        affine_over_measured: ratio(k_affine),
        network_over_measured: ratio(k_network),
    }
}

/// Index of the axis, its two walls, and the intervals of the box and of its inner part along it [m].
fn ends(simulation: &Simulation, axis: Axis) -> (usize, [Side; 2], [f64; 2]) {
    let (along, sides) = match axis {
        Axis::X => (0, [Side::Left, Side::Right]),
        Axis::Y => (1, [Side::Bottom, Side::Top]),
    };
    let [low, high] = sides.map(|side| simulation.walls.position[side as usize]);
    let cut = END * (high - low);
    (along, sides, [low + cut, high - cut])
}

/// Flux over k for a temperature difference of 1 over the length of the box, and the gradient in the inner part.
fn flux_and_gradient(simulation: &Simulation, axis: Axis) -> (f64, f64) {
    let (along, sides, [low, high]) = ends(simulation, axis);
    let count = simulation.discs.len();
    let mut links = Vec::new();
    simulation.for_each_contact(|contact| {
        // The two walls are additional nodes of the network, at the affine temperature.
        let i = match contact.i {
            Ok(i) => i,
            Err(side) if side == sides[0] => count,
            Err(side) if side == sides[1] => count + 1,
            Err(_) => return,
        };
        let conductance = conductance(&contact, &simulation.discs, 1.0);
        links.push(Link { i, j: contact.j, branch: contact.branch, conductance, share: 1.0 });
    });
    let network = Network { links, free: sorted_along(simulation, along, |_| true) };
    let fluctuation = network.fluctuations();
    let at_low_wall = network.links.iter().filter(|link| link.i == count);
    let flow: f64 =
        at_low_wall.map(|link| link.conductance * (link.branch[along] + fluctuation(link.j)[along])).sum();
    let across = simulation.walls.area()
        / (simulation.walls.position[sides[1] as usize] - simulation.walls.position[sides[0] as usize]);
    let at = |k: usize| [simulation.discs[k].x, simulation.discs[k].y][along];
    let mean_fluctuation = |section: f64| {
        // Where the cross-section cuts a contact, T′ is interpolated between its two discs.
        let crossings = network.links.iter().filter(|link| link.i < count).filter_map(|link| {
            let part = (section - at(link.i)) / link.branch[along];
            let [i, j] = [fluctuation(link.i)[along], fluctuation(link.j)[along]];
            (0.0..1.0).contains(&part).then_some(i + part * (j - i))
        });
        let (sum, crossed) = crossings.fold((0.0, 0.0f64), |(sum, n), value| (sum + value, n + 1.0));
        sum / crossed.max(1.0)
    };
    (flow / across, 1.0 + (mean_fluctuation(high) - mean_fluctuation(low)) / (high - low))
}

/// Affine and network conductivity along the axis. The windows fill the inner part from one
/// insulated wall to the other. Windows next to each other conduct in parallel (mean), those behind each other in series
/// (harmonic mean).
fn inner_windows(simulation: &Simulation, axis: Axis) -> [f64; 2] {
    let (along, _, inner) = ends(simulation, axis);
    let [left, right, bottom, top] = simulation.walls.position;
    let mut spans = [[left, right], [bottom, top]];
    spans[along] = inner;
    let size = WINDOW * simulation.mean_radius();
    let parts = spans.map(|[low, high]| ((high - low) / size).round().max(1.0) as usize);
    let corner = |at: [usize; 2]| {
        [0, 1].map(|a| spans[a][0] + (spans[a][1] - spans[a][0]) * at[a] as f64 / parts[a] as f64)
    };
    let mut resistance = [0.0; 2];
    for row in 0..parts[along] {
        let mut sum = [0.0; 2];
        for column in 0..parts[1 - along] {
            let at = if along == 0 { [row, column] } else { [column, row] };
            let a = window(simulation, corner(at), corner(at.map(|k| k + 1))).averages;
            let found = match axis {
                Axis::X => [a.conductivity_xx, a.conductivity_network_xx],
                Axis::Y => [a.conductivity_yy, a.conductivity_network_yy],
            };
            sum = [sum[0] + found[0], sum[1] + found[1]];
        }
        resistance = [0, 1].map(|k| resistance[k] + parts[1 - along] as f64 / sum[k]);
    }
    resistance.map(|r| parts[along] as f64 / r)
}

/// A square lattice that touches its walls: every row is a chain, so affine estimate, network and measurement
/// agree.
#[test]
fn lattice_between_walls_is_exact() {
    let (n, r, d) = (16, 5e-3, 9.8e-3);
    let at = |k: usize| 4.9e-3 + d * k as f64;
    let places = (0..n * n).map(|k| Disc::at_rest(at(k % n), at(k / n), r, 3000.0));
    let size = d * n as f64;
    let lattice = Simulation::new(Material::default(), places.collect(), Walls::around(size, size));
    for axis in [Axis::X, Axis::Y] {
        let check = heat_check(&lattice, axis);
        assert!((check.network_over_measured - 1.0).abs() < 1e-12, "{check:?}");
        // Windows that end at the insulated walls cut no contact there: with n − 1 or n rows the result is the
        // same.
        assert!((check.affine_over_measured - 1.0).abs() < 1e-12, "{check:?}");
    }
}

#[test]
fn packed_box_agrees_with_the_network_and_not_with_affine() {
    let spec = PackingSpec {
        discs: 400,
        seed: 2,
        porosity: 0.12,
        compression: Compression::Horizontal,
        ..PackingSpec::default()
    };
    let simulation = pack(&spec, &Material::default()).unwrap().simulation;
    let [x, y] = [Axis::X, Axis::Y].map(|axis| heat_check(&simulation, axis));
    for check in [x, y] {
        assert!((0.97..1.05).contains(&check.network_over_measured), "{check:?}");
        assert!(check.affine_over_measured > check.network_over_measured + 0.01, "{check:?}");
    }
    assert!(x.k_measured > 1.05 * y.k_measured, "{x:?} {y:?}");
}

/// A chain that starts at one wall and ends one grain short of the other.
#[test]
fn dead_ends_conduct_nothing() {
    let d = 9.8e-3;
    let discs = (0..30).map(|k| Disc::at_rest(0.5 * d + d * f64::from(k), 0.05, 5e-3, 3000.0)).collect();
    let simulation = Simulation::new(Material::default(), discs, Walls::around(31.0 * d, 0.1));
    let check = heat_check(&simulation, Axis::X);
    assert!(check.k_measured == 0.0 && check.k_affine > 0.01, "{check:?}");
    assert_eq!(check.affine_over_measured, 0.0);
}

#[test]
fn loose_discs_conduct_nothing() {
    let discs = (0..20).map(|k| Disc::at_rest(0.02 + 0.02 * f64::from(k), 0.1, 5e-3, 3000.0)).collect();
    let loose = Simulation::new(Material::default(), discs, Walls::around(0.5, 0.2));
    let check = heat_check(&loose, Axis::X);
    assert_eq!((check.k_measured, check.k_affine, check.k_network), (0.0, 0.0, 0.0));
    assert_eq!(check.network_over_measured, 0.0);
}
