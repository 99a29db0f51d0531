use msdd_beds::coupled::{prepare, run};
use msdd_beds::scene::Scene;
use std::time::Instant;
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = Scene::read(std::path::Path::new(&std::env::args().nth(1).unwrap()))?;
    let t = Instant::now();
    let prepared = prepare(&scene, std::env::args().nth(3).map_or(1, |n| n.parse().unwrap()), |_, _| ())?;
    for (stage, rest) in &prepared.stages {
        println!("{stage} {rest:?}");
    }
    println!("{:.1}", t.elapsed().as_secs_f64());
    let found = run(&scene, &prepared, |_| ())?;
    println!("{:.1} steps {}", t.elapsed().as_secs_f64(), found.steps);
    for r in &found.rows {
        println!(
            "{:6.0} T {:?} s {:.0?} w {:.0?} phi {:.5} z {:.3} K {:.4} {:.4} d {:.6} R {:.6} u {:.1e} peak {:.3}",
            r.time,
            r.temperatures.iter().map(|t| (t * 100.0).round() / 100.0).collect::<Vec<_>>(),
            r.stress,
            r.walls,
            1.0 - r.porosity,
            r.coordination,
            r.contact_conductivity,
            r.gas_conductivity,
            r.depth,
            r.radius,
            r.unbalanced,
            r.peak
        );
    }
    if let Some(file) = std::env::args().nth(2) {
        std::fs::write(file, msdd_beds::rows::elements(&scene, &prepared, &found))?;
    }
    println!("stored {} residual {} heat steps {}", found.stored, found.residual, found.heat_steps);
    Ok(())
}
