//! ParaView files: particles and contacts (force chains) as VTK PolyData, and the time series that lists them.

use msdd_beds::vtk::poly_data;
use msdd_dem::{Disc, Simulation};
use std::fmt::Write;

/// Particles as points with radius, velocity, angular velocity, temperature and number of contacts (XML PolyData).
pub fn particles(simulation: &Simulation) -> String {
    let discs = &simulation.discs;
    let mut contacts = vec![0u32; discs.len()];
    simulation.for_each_contact(|contact| contact.discs().for_each(|k| contacts[k] += 1));
    let places = discs.iter().map(|d| format!("{} {} 0", d.x, d.y)).collect();
    let of = |value: &dyn Fn(&Disc) -> String| discs.iter().map(value).collect();
    let arrays = [
        ("Float64", "radius", 1, of(&|d| d.radius.to_string())),
        ("Float64", "velocity", 3, of(&|d| format!("{} {} 0", d.vx, d.vy))),
        ("Float64", "angular_velocity", 1, of(&|d| d.angular_velocity.to_string())),
        ("Float64", "temperature", 1, of(&|d| d.temperature.to_string())),
        ("Float64", "contacts", 1, contacts.iter().map(u32::to_string).collect()),
    ];
    poly_data(false, places, &arrays)
}

/// Contacts as lines along the branch with normal and tangential force \[N\] (XML PolyData).
pub fn contacts(simulation: &Simulation) -> String {
    let (mut points, mut normal, mut tangential) = (Vec::new(), Vec::new(), Vec::new());
    simulation.for_each_contact(|contact| {
        let [dx, dy] = contact.branch;
        points.push(match contact.i {
            // Contacts across a periodic border are drawn from i to the place of the image of j.
            Ok(i) if contact.shift != [0, 0] => {
                let disc = &simulation.discs[i];
                format!("{} {} 0 {} {} 0", disc.x, disc.y, disc.x + dx, disc.y + dy)
            }
            _ => {
                let disc = &simulation.discs[contact.j];
                format!("{} {} 0 {} {} 0", disc.x - dx, disc.y - dy, disc.x, disc.y)
            }
        });
        normal.push(contact.normal_force().to_string());
        tangential.push(contact.tangential_force.to_string());
    });
    let arrays = [("Float64", "normal_force", 1, normal), ("Float64", "tangential_force", 1, tangential)];
    poly_data(true, points, &arrays)
}

/// A time series (PVD) of files next to it: (time \[s\] or strain, file name).
pub fn series(files: &[(f64, String)]) -> String {
    let mut text = String::from("<VTKFile type=\"Collection\" version=\"0.1\"><Collection>\n");
    for (time, file) in files {
        let _ = writeln!(text, "<DataSet timestep=\"{time}\" file=\"{file}\"/>");
    }
    text + "</Collection></VTKFile>\n"
}
