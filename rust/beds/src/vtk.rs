//! Grains as a file that ParaView opens (XML PolyData).

use msdd_spheres::Simulation;
use std::fmt::Write;

/// Grains as points with radius, number of contacts, and further numbers by name, one a grain.
pub fn grains(simulation: &Simulation, further: &[(String, &[f64])]) -> String {
    let spheres = &simulation.spheres;
    let count = spheres.len();
    let mut contacts = vec![0u32; count];
    simulation.for_each_contact(|contact| contact.spheres().for_each(|k| contacts[k] += 1));
    let mut file = format!(
        "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\"><PolyData>\n\
         <Piece NumberOfPoints=\"{count}\" NumberOfVerts=\"{count}\" NumberOfLines=\"0\" NumberOfStrips=\"0\" \
         NumberOfPolys=\"0\">\n<Points>\n"
    );
    let place = |p: [f64; 3]| format!("{} {} {}", p[0], p[1], p[2]);
    array(&mut file, ("Float64", "", 3), spheres.iter().map(|s| place(s.position)));
    file += "</Points>\n<Verts>\n";
    array(&mut file, ("Int64", "connectivity", 1), (0..count).map(|k| k.to_string()));
    array(&mut file, ("Int64", "offsets", 1), (1..=count).map(|k| k.to_string()));
    file += "</Verts>\n<PointData Scalars=\"radius\">\n";
    array(&mut file, ("Float64", "radius", 1), spheres.iter().map(|s| s.radius.to_string()));
    array(&mut file, ("Int64", "contacts", 1), contacts.iter().map(u32::to_string));
    for (name, values) in further {
        array(&mut file, ("Float64", name, 1), values.iter().map(f64::to_string));
    }
    file + "</PointData>\n</Piece></PolyData></VTKFile>\n"
}

fn array(file: &mut String, (kind, name, width): (&str, &str, usize), values: impl Iterator<Item = String>) {
    let named = if name.is_empty() { String::new() } else { format!("Name=\"{name}\" ") };
    let _ =
        writeln!(file, "<DataArray type=\"{kind}\" {named}NumberOfComponents=\"{width}\" format=\"ascii\">");
    for value in values {
        let _ = writeln!(file, "{value}");
    }
    file.push_str("</DataArray>\n");
}
