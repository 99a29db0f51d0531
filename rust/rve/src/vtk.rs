//! ParaView files: particles and contacts (force chains) as VTK PolyData, and the time series that lists them.

use msdd_dem::Simulation;
use std::fmt::Write;

/// Particles as points with radius, velocity, angular velocity, temperature and number of contacts (XML PolyData).
pub fn particles(simulation: &Simulation) -> String {
    let discs = &simulation.discs;
    let mut contacts = vec![0u32; discs.len()];
    simulation.for_each_contact(|contact| contact.discs().for_each(|k| contacts[k] += 1));
    let mut file = head(discs.len(), 0);
    array(&mut file, "Points", "", 3, discs.iter().map(|d| format!("{} {} 0", d.x, d.y)));
    array(&mut file, "Verts", "connectivity", 1, (0..discs.len()).map(|k| k.to_string()));
    array(&mut file, "Verts", "offsets", 1, (1..=discs.len()).map(|k| k.to_string()));
    file += "<PointData Scalars=\"radius\">\n";
    data(&mut file, "radius", 1, discs.iter().map(|d| d.radius.to_string()));
    data(&mut file, "velocity", 3, discs.iter().map(|d| format!("{} {} 0", d.vx, d.vy)));
    data(&mut file, "angular_velocity", 1, discs.iter().map(|d| d.angular_velocity.to_string()));
    data(&mut file, "temperature", 1, discs.iter().map(|d| d.temperature.to_string()));
    data(&mut file, "contacts", 1, contacts.iter().map(|c| c.to_string()));
    file + "</PointData>\n</Piece></PolyData></VTKFile>\n"
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
    let count = points.len();
    let mut file = head(2 * count, count);
    array(&mut file, "Points", "", 3, points.into_iter());
    array(&mut file, "Lines", "connectivity", 1, (0..2 * count).map(|k| k.to_string()));
    array(&mut file, "Lines", "offsets", 1, (1..=count).map(|k| (2 * k).to_string()));
    file += "<CellData Scalars=\"normal_force\">\n";
    data(&mut file, "normal_force", 1, normal.into_iter());
    data(&mut file, "tangential_force", 1, tangential.into_iter());
    file + "</CellData>\n</Piece></PolyData></VTKFile>\n"
}

/// A time series (PVD) of files next to it: (time \[s\] or strain, file name).
pub fn series(files: &[(f64, String)]) -> String {
    let mut text = String::from("<VTKFile type=\"Collection\" version=\"0.1\"><Collection>\n");
    for (time, file) in files {
        let _ = writeln!(text, "<DataSet timestep=\"{time}\" file=\"{file}\"/>");
    }
    text + "</Collection></VTKFile>\n"
}

/// Opens a piece with `points` points and either as many vertices or `lines` lines.
fn head(points: usize, lines: usize) -> String {
    let vertices = if lines == 0 { points } else { 0 };
    format!(
        "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\"><PolyData>\n\
         <Piece NumberOfPoints=\"{points}\" NumberOfVerts=\"{vertices}\" NumberOfLines=\"{lines}\" \
         NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n"
    )
}

/// One array in a section of its own, or one of the two arrays of a cell section.
fn array(file: &mut String, section: &str, name: &str, width: usize, values: impl Iterator<Item = String>) {
    if name != "offsets" {
        let _ = writeln!(file, "<{section}>");
    }
    let kind = if name.is_empty() { "Float64" } else { "Int64" };
    write_array(file, kind, name, width, values);
    if name != "connectivity" {
        let _ = writeln!(file, "</{section}>");
    }
}

fn data(file: &mut String, name: &str, width: usize, values: impl Iterator<Item = String>) {
    write_array(file, "Float64", name, width, values);
}

fn write_array(
    file: &mut String,
    kind: &str,
    name: &str,
    width: usize,
    values: impl Iterator<Item = String>,
) {
    let named = if name.is_empty() { String::new() } else { format!("Name=\"{name}\" ") };
    let _ =
        writeln!(file, "<DataArray type=\"{kind}\" {named}NumberOfComponents=\"{width}\" format=\"ascii\">");
    for value in values {
        let _ = writeln!(file, "{value}");
    }
    file.push_str("</DataArray>\n");
}
