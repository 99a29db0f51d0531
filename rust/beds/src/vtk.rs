//! Grains as a file that ParaView opens (XML PolyData).

use msdd_spheres::Simulation;
use std::fmt::Write;

/// A list of a file: type, name, numbers in each value, and the values as text.
pub type Array<'a> = (&'static str, &'a str, usize, Vec<String>);

/// Grains as points with radius, number of contacts, and further numbers by name, one a grain.
pub fn grains(simulation: &Simulation, further: &[(String, &[f64])]) -> String {
    let spheres = &simulation.spheres;
    let mut contacts = vec![0u32; spheres.len()];
    simulation.for_each_contact(|contact| contact.spheres().for_each(|k| contacts[k] += 1));
    let places: Vec<String> =
        spheres.iter().map(|s| s.position).map(|[x, y, z]| format!("{x} {y} {z}")).collect();
    let mut arrays: Vec<Array> = vec![
        ("Float64", "radius", 1, spheres.iter().map(|s| s.radius.to_string()).collect()),
        ("Int64", "contacts", 1, contacts.iter().map(u32::to_string).collect()),
    ];
    for (name, values) in further {
        arrays.push(("Float64", name, 1, values.iter().map(f64::to_string).collect()));
    }
    poly_data(false, places, &arrays)
}

/// A file of points, or of lines: `places` has the coordinates of a point, or of both ends of a line. The first of `arrays`, which have
/// a value for each of them, is what is shown.
pub fn poly_data(lines: bool, places: Vec<String>, arrays: &[Array]) -> String {
    let (ends, cells, data) = if lines { (2, "Lines", "CellData") } else { (1, "Verts", "PointData") };
    let count = places.len();
    let points = ends * count;
    let [verts, lines] = if lines { [0, count] } else { [count, 0] };
    let mut file = format!(
        "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\"><PolyData>\n\
         <Piece NumberOfPoints=\"{points}\" NumberOfVerts=\"{verts}\" NumberOfLines=\"{lines}\" \
         NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<Points>\n"
    );
    write_array(&mut file, &("Float64", "", 3, places));
    let _ = write!(file, "</Points>\n<{cells}>\n");
    write_array(&mut file, &("Int64", "connectivity", 1, (0..points).map(|k| k.to_string()).collect()));
    write_array(&mut file, &("Int64", "offsets", 1, (1..=count).map(|k| (ends * k).to_string()).collect()));
    let shown = arrays.first().map_or("", |array| array.1);
    let _ = write!(file, "</{cells}>\n<{data} Scalars=\"{shown}\">\n");
    arrays.iter().for_each(|array| write_array(&mut file, array));
    file + &format!("</{data}>\n</Piece></PolyData></VTKFile>\n")
}

fn write_array(file: &mut String, (kind, name, width, values): &Array) {
    let named = if name.is_empty() { String::new() } else { format!("Name=\"{name}\" ") };
    let _ =
        writeln!(file, "<DataArray type=\"{kind}\" {named}NumberOfComponents=\"{width}\" format=\"ascii\">");
    for value in values {
        let _ = writeln!(file, "{value}");
    }
    file.push_str("</DataArray>\n");
}
