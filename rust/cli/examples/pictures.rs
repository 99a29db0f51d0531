//! Draws pictures of the book from `docs/results.json` and the data in `cases`, and with RUNS those of runs that `scripts/picture`
//! has made. Titles with numbers are computed from the data.
//!
//! ```sh
//! cargo run --release -p msdd-cli --example pictures -- docs/src/images [results/picture]
//! ```

use msdd_case::{mesh::Mesh, results::Field, tables};
use msdd_draw::text::significant;
use msdd_draw::{Axis, Cells, Line, Map, Marker, Series, Sheet, Style, from_data, plot_named, series};
use serde_json::Value;
use std::collections::BTreeMap;
use std::error::Error;
use std::path::{Path, PathBuf};

type Points = Vec<(f64, f64)>;
type Drawn = Result<String, Box<dyn Error>>;

fn main() -> Result<(), Box<dyn Error>> {
    let usage = "usage: pictures IMAGES [RUNS]";
    let images = PathBuf::from(std::env::args().nth(1).ok_or(usage)?);
    let runs = std::env::args().nth(2).map(PathBuf::from);
    let results = Results(serde_json::from_str(&std::fs::read_to_string("docs/results.json")?)?);
    let mut all = vec![
        ("beds", beds(&results)),
        ("validity", validity()),
        ("measured", measured()),
        ("law", law(&results)),
        ("paths", paths(&results)),
        ("cost", cost(&results)),
        ("steps", steps(&results)),
        ("contrast", contrast(&results)),
        ("slant", slant(&results)),
    ];
    if let Some(runs) = &runs {
        all.extend([
            ("grains", grains(&runs.join("beaulieu"))),
            ("cycles", cycles(&runs.join("cycled"))),
            ("column", column(&runs.join("column"))),
            ("silo", silo(&runs.join("silo"))),
            ("band", band(&runs.join("band.chosen"))),
            ("discs", discs(Path::new("results/summary.json"))),
        ]);
    }
    for (name, svg) in all {
        let file = images.join(format!("{name}.svg"));
        std::fs::write(&file, svg.map_err(|error| format!("{name}: {error}"))?)?;
        println!("{}", file.display());
    }
    Ok(())
}

/// `docs/results.json`.
struct Results(Value);

impl Results {
    /// The rows of a table.
    fn rows(&self, name: &str) -> Vec<Vec<String>> {
        let sections = self.0["sections"].as_object().into_iter().flat_map(|sections| sections.values());
        let table = sections.filter_map(|section| section["tables"].get(name)).next();
        let rows = table.and_then(|table| table["rows"].as_array()).into_iter().flatten();
        let cells = |row: &Value| row.as_array().into_iter().flatten().map(text).collect();
        rows.map(cells).collect()
    }
}

fn text(value: &Value) -> String {
    value.as_str().unwrap_or_default().to_string()
}

/// The first number of a cell.
fn number(cell: &str) -> f64 {
    let digits: String = cell.chars().filter(|c| *c != '\u{a0}').collect();
    digits.split_whitespace().next().and_then(|word| word.parse().ok()).unwrap_or(f64::NAN)
}

/// Largest of the numbers, as text with two digits.
fn most(values: impl Iterator<Item = f64>) -> String {
    significant(values.fold(0.0, f64::max), 2)
}

fn circle(colour: usize) -> Style {
    Style::marker(colour, Marker::Circle)
}

fn log(label: &str, range: (f64, f64)) -> Axis<'_> {
    Axis { label, log: true, range: Some(range) }
}

fn line(points: Points, colour: usize, kind: Line) -> Series {
    series(points, Style::line(colour, kind))
}

/// Columns of a CSV file by their names; lines that begin with # are comments.
fn csv(file: &Path) -> Result<BTreeMap<String, Vec<String>>, Box<dyn Error>> {
    let text = std::fs::read_to_string(file).map_err(|error| format!("{}: {error}", file.display()))?;
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let names: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
    let mut columns: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for row in lines {
        for (name, cell) in names.iter().zip(row.split(',')) {
            columns.entry(name.to_string()).or_default().push(cell.to_string());
        }
    }
    Ok(columns)
}

fn numbers(columns: &BTreeMap<String, Vec<String>>, name: &str) -> Vec<f64> {
    columns.get(name).map(|cells| cells.iter().map(|cell| number(cell)).collect()).unwrap_or_default()
}

/// Errors of the sixteen beds over the scatter of their packings.
fn beds(results: &Results) -> Drawn {
    let rows = results.rows("beds-errors");
    let quantity = |error: usize| -> Points {
        rows.iter().map(|row| (number(&row[error + 1]), number(&row[error]))).collect()
    };
    let [t, p, k] = [4, 6, 8].map(quantity);
    let within = p.iter().filter(|point| point.1 < 10.0).count();
    let title = format!(
        "T within {} %; p within 10 % in {within} of {} beds",
        most(t.iter().map(|x| x.1)),
        rows.len()
    );
    let list = vec![
        ("temperature".into(), series(t, circle(1))),
        ("pressure".into(), series(p, Style::marker(2, Marker::Square))),
        ("conductivity".into(), series(k, Style::marker(3, Marker::Triangle))),
        ("error = scatter".into(), line(vec![(0.05, 0.05), (30.0, 30.0)], 4, Line::Dashed)),
    ];
    let (x, y) = ("scatter of one packing, rms [%]", "error of the solver, rms [%]");
    Ok(plot_named(&title, &log(x, (0.05, 30.0)), &log(y, (0.1, 40.0)), list)?)
}

/// Where the model was compared with DEM: pressure over E* and thermal strain of all beds, and the range that the solver reports.
fn validity() -> Drawn {
    let mut folders: Vec<PathBuf> = ["cases/beds", "cases/hot"]
        .iter()
        .flat_map(|folder| std::fs::read_dir(folder).into_iter().flatten().flatten())
        .map(|entry| entry.path())
        .filter(|path| path.join("bed.toml").is_file())
        .collect();
    folders.sort();
    let mut kinds = [Vec::new(), Vec::new()];
    for folder in &folders {
        let text = std::fs::read_to_string(folder.join("bed.toml"))?;
        let key = |name: &str| {
            let line = text.lines().find_map(|line| line.strip_prefix(name)?.trim().strip_prefix('='));
            line.map_or(f64::NAN, |value| number(value.trim()))
        };
        let expansion = Some(key("thermal_expansion")).filter(|a| a.is_finite()).unwrap_or(0.0);
        let modulus = key("young_modulus") / (2.0 * (1.0 - key("poisson_ratio").powi(2)));
        for file in std::fs::read_dir(folder)?.flatten().map(|entry| entry.path()) {
            let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if !(name.starts_with("dem-") && name.ends_with(".csv")) {
                continue;
            }
            let columns = csv(&file)?;
            let (t, p) = (numbers(&columns, "T_mean"), numbers(&columns, "p"));
            let start = t.first().copied().unwrap_or(f64::NAN);
            let strain = |t: f64| 1e4 * expansion * (t - start);
            let points = t.iter().zip(p).map(|(t, p)| (strain(*t), p / modulus));
            kinds[usize::from(folder.starts_with("cases/hot"))].extend(points);
        }
    }
    let compared: Value =
        serde_json::from_str(&std::fs::read_to_string("rust/surrogate/src/compared.json")?)?;
    let ends = |key: &str| [0, 1].map(|k| compared["spheres"][key][k].as_f64().unwrap_or(f64::NAN));
    let (strain, pressure) = (ends("thermal_strain").map(|e| 1e4 * e), ends("reduced_pressure"));
    let corners = [(0, 0), (1, 0), (1, 1), (0, 1), (0, 0)].map(|(a, b)| (strain[a], pressure[b]));
    let [beds, hot] = kinds;
    let small = |colour, marker| Style { size: 2, ..Style::marker(colour, marker) };
    let title = format!(
        "Compared with DEM: p/E* of {} to {}, {} beds",
        msdd_draw::number(pressure[0]),
        msdd_draw::number(pressure[1]),
        folders.len()
    );
    let list = vec![
        ("sixteen beds".into(), series(beds, small(2, Marker::Circle))),
        ("hot beds".into(), series(hot, small(1, Marker::Triangle))),
        ("no warning inside".into(), line(corners.to_vec(), 0, Line::Solid)),
    ];
    let y = Axis { label: "p/E* (1e-7: 12 kPa in steel)", log: true, range: Some((1e-8, 1e-5)) };
    Ok(plot_named(&title, &from_data("thermal strain [1e-4]", false), &y, list)?)
}

/// Conductivity of Zehner's beds: prediction over measurement.
fn measured() -> Drawn {
    let columns = csv(Path::new("cases/zehner/prediction.csv"))?;
    let (found, predicted) = (numbers(&columns, "measured"), numbers(&columns, "prediction_rough"));
    let temperature = numbers(&columns, "temperature");
    let of = |materials: &[&str], hot: bool| -> Points {
        let own = |k: &usize| {
            let named = materials.contains(&columns["material"][*k].as_str());
            // SK05/70 has 1.6 times its neighbours
            named && (temperature[*k] > 350.0) == hot && columns["series"][*k] != "SK05/70"
        };
        (0..found.len()).filter(own).map(|k| (found[k], predicted[k])).collect()
    };
    let ceramics = ["steatite", "ceramic"];
    let all: Vec<(f64, f64)> =
        [true, false].iter().flat_map(|&hot| [of(&["steel"], hot), of(&ceramics, hot)].concat()).collect();
    let within = all.iter().filter(|(m, p)| (p / m - 1.0).abs() < 0.2).count();
    let title = format!("{within} of {} beds of steel and ceramics within 20 %", all.len());
    let diagonal = |f: f64| vec![(4.0, 4.0 * f), (80.0, 80.0 * f)];
    let hollow = |style: Style| Style { hollow: true, ..style };
    let list = vec![
        ("steel, below 350 K".into(), series(of(&["steel"], false), circle(2))),
        ("steel, above".into(), series(of(&["steel"], true), hollow(circle(2)))),
        ("ceramics, below 350 K".into(), series(of(&ceramics, false), Style::marker(1, Marker::Square))),
        ("ceramics, above".into(), series(of(&ceramics, true), hollow(Style::marker(1, Marker::Square)))),
        ("copper".into(), series(of(&["copper"], false), Style::marker(0, Marker::Cross))),
        ("± 20 %".into(), line(diagonal(1.2), 4, Line::Dashed)),
        (String::new(), line(diagonal(0.8), 4, Line::Dashed)),
        (String::new(), line(diagonal(1.0), 4, Line::Solid)),
    ];
    let (x, y) = ("measured K over that of the gas", "predicted");
    Ok(plot_named(&title, &log(x, (4.0, 80.0)), &log(y, (4.0, 160.0)), list)?)
}

/// Errors of the law of spheres along held-out paths, over the scatter between packings.
fn law(results: &Results) -> Drawn {
    let rows = results.rows("spheres-law");
    let of = |column: usize| -> Points {
        let pair = |row: &Vec<String>| {
            let scatter = row[column].split_once('(')?.1.trim_end_matches(')').parse().ok()?;
            Some((scatter, number(&row[column])))
        };
        rows.iter().filter_map(pair).collect()
    };
    let all: Points = (3..7).flat_map(of).collect();
    let twice = all.iter().filter(|(scatter, error)| *error < 1.5 * scatter).count();
    let title = format!("{twice} of {} errors are below 1.5 times the scatter", all.len());
    let list = vec![
        ("pressure".into(), series(of(3), Style::marker(2, Marker::Square))),
        ("deviator".into(), series(of(4), circle(1))),
        ("K by contacts".into(), series(of(5), Style::marker(3, Marker::Triangle))),
        ("K by gas".into(), series(of(6), Style::marker(5, Marker::Diamond))),
        ("error = scatter".into(), line(vec![(0.5, 0.5), (20.0, 20.0)], 4, Line::Dashed)),
    ];
    let (x, y) = ("scatter between packings [%]", "error on held-out paths [%]");
    Ok(plot_named(&title, &log(x, (0.5, 20.0)), &log(y, (0.5, 20.0)), list)?)
}

/// Errors of the law of discs along paths of held-out packings.
fn paths(results: &Results) -> Drawn {
    let rows = results.rows("surrogate-paths");
    let of = |discs: f64| -> Points {
        let own = rows.iter().filter(|row| number(&row[1].replace('\u{a0}', "")) == discs);
        own.map(|row| (number(&row[4]), number(&row[6]))).collect()
    };
    let within = rows.iter().filter(|row| number(&row[4]) < 4.0 && number(&row[6]) < 4.0).count();
    let title = format!("p and K within 4 % on {within} of {} kinds of paths", rows.len());
    let list = vec![
        ("500 discs".into(), series(of(500.0), circle(2))),
        ("2000 discs".into(), series(of(2000.0), Style::marker(1, Marker::Square))),
    ];
    let [x, y] =
        ["error of the pressure [%]", "error of the mean K [%]"].map(|label| from_data(label, false));
    Ok(plot_named(&title, &x, &y, list)?)
}

/// Error of T over processor time, for case HC.
fn cost(results: &Results) -> Drawn {
    let rows = results.rows("speed-accuracy");
    let of = |wanted: &dyn Fn(&str) -> bool| -> Points {
        let pair = |row: &Vec<String>| {
            let (error, time) = row[3].split_once(" % in ")?;
            Some((number(time), number(error))).filter(|_| wanted(&row[0]))
        };
        rows.iter().filter_map(pair).collect()
    };
    let adaptive = of(&|name| name == "grains move, adaptive steps");
    let discs = of(&|name| name.starts_with("15 000 discs") || name.starts_with("15\u{a0}000 discs"));
    let ((time, error), dem) =
        (adaptive.first().ok_or("no row of grains that move")?, discs.first().map_or(f64::NAN, |d| d.0));
    let title = format!("Case HC: {error} % in {time} s, DEM takes {dem:.0} s");
    let list = vec![
        ("grains move".into(), series(of(&|name| name.starts_with("grains move")), circle(2))),
        (
            "grains stay".into(),
            series(
                of(&|name| name.starts_with("paper's scheme") || name.starts_with("adaptive")),
                Style::marker(1, Marker::Square),
            ),
        ),
        (
            "other models".into(),
            series(
                of(&|name| {
                    name.contains("network") || name.contains("medium") || name.contains("does not change")
                }),
                Style::marker(5, Marker::Diamond),
            ),
        ),
        (
            "boxes in cells".into(),
            series(of(&|name| name.contains("box")), Style::marker(3, Marker::Triangle)),
        ),
        ("scatter of DEM".into(), series(discs, Style { size: 6, ..Style::marker(0, Marker::Cross) })),
    ];
    let (x, y) = ("processor time [s]", "largest error of T [% of the range]");
    Ok(plot_named(&title, &log(x, (0.1, 1000.0)), &log(y, (0.1, 10.0)), list)?)
}

/// Error of T over the step, for both time schemes.
fn steps(results: &Results) -> Drawn {
    let rows = results.rows("coupling");
    let of = |scheme: &str| -> Points {
        let own = rows.iter().filter(|row| row[0] == scheme);
        own.map(|row| (number(&row[1]), number(&row[2]))).collect()
    };
    let [paper, second] = ["paper", "secondOrder"].map(of);
    let title = "Second order needs a tenth of the steps or less";
    let dot = |colour, marker| Style { line: Line::Solid, ..Style::marker(colour, marker) };
    let list = vec![
        ("paper".into(), series(paper, dot(1, Marker::Square))),
        ("secondOrder".into(), series(second, dot(2, Marker::Circle))),
    ];
    let (x, y) = ("step [ms]", "largest error of T [K]");
    Ok(plot_named(title, &log(x, (4.0, 3000.0)), &log(y, (1e-4, 30.0)), list)?)
}

/// Error of the heat flow over the ratio of conductivities.
fn contrast(results: &Results) -> Drawn {
    let rows = results.rows("contrast");
    let styles = [circle(1), Style::marker(2, Marker::Square), Style::marker(3, Marker::Triangle)];
    let mut list = Vec::new();
    for (cells, style) in ["10", "30", "100"].into_iter().zip(styles) {
        let own = rows.iter().filter(|row| row[1] == cells);
        let points = own.map(|row| (number(&row[0]), number(&row[3]))).collect();
        list.push((format!("{cells} cells"), series(points, Style { line: Line::Solid, ..style })));
    }
    let worst = most(rows.iter().filter(|row| row[1] == "100").map(|row| number(&row[3])));
    let title = format!("A jump of conductivity costs {worst} % with 100 cells");
    let x = log("ratio of the conductivities", (0.7, 2e6));
    Ok(plot_named(&title, &x, &from_data("error of the heat flow [%]", false), list)?)
}

/// Error of T over the angle of slanted cells.
fn slant(results: &Results) -> Drawn {
    let rows = results.rows("slant");
    let kinds = [
        ("50 × 15", "0", circle(1)),
        ("50 × 15", "3", Style::marker(2, Marker::Square)),
        ("100 × 30", "0", Style::marker(3, Marker::Triangle)),
    ];
    let mut list = Vec::new();
    for (cells, corrections, style) in kinds {
        let own = rows.iter().filter(|row| row[1] == cells && row[2] == corrections);
        let points = own.map(|row| (number(&row[0]), number(&row[3]))).collect();
        let name = format!("{cells} cells, {corrections} corrections");
        list.push((name, series(points, Style { line: Line::Solid, ..style })));
    }
    let upright = most(rows.iter().filter(|row| number(&row[0]) <= 60.0).map(|row| number(&row[3])));
    let title = format!("Cells slanted by up to 60 degrees: below {upright} %");
    let (x, y) = ("angle [degrees]", "error of T [% of the range]");
    Ok(plot_named(&title, &from_data(x, false), &from_data(y, false), list)?)
}

/// A cut through the bed that was heated from above: the spheres that it meets, coloured by T.
fn grains(folder: &Path) -> Drawn {
    let text = std::fs::read_to_string(folder.join("grains.vtp"))?;
    let array = |start: &str| -> Vec<f64> {
        let body = text.split_once(start).map_or("", |parts| parts.1);
        let body = body.split_once('>').map_or("", |parts| parts.1);
        let body = body.split_once("</DataArray>").map_or("", |parts| parts.0);
        body.split_whitespace().filter_map(|word| word.parse().ok()).collect()
    };
    let (places, radii) = (array("<Points>\n<DataArray"), array("Name=\"radius\""));
    let temperatures = array("Name=\"T_held\"");
    let middle = places.chunks(3).map(|p| p[0]).sum::<f64>() / radii.len().max(1) as f64;
    let (mut circles, mut values) = (Vec::new(), Vec::new());
    for ((place, radius), t) in places.chunks(3).zip(&radii).zip(&temperatures) {
        let off = place[0] - middle;
        // Small ends of spheres are left out
        if off.abs() < 0.9 * radius {
            circles.push(([place[2], place[1]], (radius * radius - off * off).sqrt()));
            values.push(*t);
        }
    }
    let title = format!("Cut through {} steel spheres after 4000 s", radii.len());
    let sheet = Sheet { title: &title, label: "T [K]", ..Sheet::default() };
    let cells = Cells::Circles(circles);
    Ok(msdd_draw::maps(&sheet, &[Map { name: "heated from above", cells: &cells, values: &values }]))
}

/// Columns 0 and `column` of a table of a run, the second times `factor`.
fn table(run: &Path, name: &str, column: usize, factor: f64) -> Result<Points, Box<dyn Error>> {
    let rows = tables::read(run, name, None)?.numbers()?;
    Ok(rows.iter().filter_map(|row| Some((row[0], factor * row.get(column)?))).collect())
}

/// Stress on the side of the store over ten cycles, by DEM and by the solver.
fn cycles(run: &Path) -> Drawn {
    let (dem, scatter) = (csv(&run.join("dem.csv"))?, csv(&run.join("dem-scatter.csv"))?);
    let hours = |points: Points| points.into_iter().map(|(t, p)| (t / 3600.0, 1e-3 * p)).collect::<Points>();
    let points = hours(numbers(&dem, "time").into_iter().zip(numbers(&dem, "p_side")).collect());
    // yy is across the side; in DEM the force is over the whole radius
    let solver = hours(table(run, "wall", 4, -0.975)?);
    let at = |points: &Points, t: f64| points.iter().find(|p| (p.0 - t).abs() < 0.01).map(|p| p.1);
    let errors: Vec<f64> =
        points.iter().skip(1).filter_map(|(t, p)| Some(at(&solver, *t)? / p - 1.0)).collect();
    let rms = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
    let bars = numbers(&scatter, "p_side").iter().map(|p| 1e-3 * p).collect();
    let list = vec![
        ("solver".into(), line(solver, 2, Line::Solid)),
        ("DEM, mean and scatter of three packings".into(), Series { points, bars, style: circle(1) }),
    ];
    let title = format!("Ten cycles: stress on the side within {:.1} % (rms)", 100.0 * rms);
    let [x, y] = ["time [h]", "stress on the side [kPa]"].map(|label| from_data(label, false));
    Ok(plot_named(&title, &x, &y, list)?)
}

/// T at five heights of the column, by DEM and by the solver.
fn column(run: &Path) -> Drawn {
    let dem = csv(&run.join("dem.csv"))?;
    let times = numbers(&dem, "time");
    let mut list = Vec::new();
    let (mut square, mut count, mut ends) = (0.0, 0.0, (f64::INFINITY, f64::NEG_INFINITY));
    for (k, height) in ["0.03", "0.06", "0.09", "0.12", "0.15"].into_iter().enumerate() {
        let found = numbers(&dem, &format!("T_{height}"));
        let solver = table(run, "probes", k + 1, 1.0)?;
        for (t, value) in times.iter().zip(&found) {
            ends = (ends.0.min(*value), ends.1.max(*value));
            if let Some(own) = solver.iter().find(|p| (p.0 - t).abs() < 1.0) {
                (square, count) = (square + (own.1 - value).powi(2), count + 1.0);
            }
        }
        let hours = |points: Points| points.into_iter().map(|(t, v)| (t / 3600.0, v)).collect::<Points>();
        let colour = [1, 0, 2, 3, 5][k];
        list.push((format!("{:.0} mm", 1e3 * number(height)), line(hours(solver), colour, Line::Solid)));
        let points = hours(times.iter().copied().zip(found).collect());
        list.push((String::new(), series(points, Style { size: 3, ..circle(colour) })));
    }
    let error = 100.0 * (square / count).sqrt() / (ends.1 - ends.0);
    let title = format!("T above the floor within {error:.1} % (rms); points: DEM");
    let [x, y] = ["time [h]", "T [K]"].map(|label| from_data(label, false));
    Ok(plot_named(&title, &x, &y, list)?)
}

/// Stress on the side of a silo over the depth, at rest and heated, with Janssen's curve.
fn silo(run: &Path) -> Drawn {
    let mesh = Mesh::read(run, "")?;
    let side = mesh.patches.iter().find(|patch| patch.name == "side").ok_or("no patch 'side'")?;
    let top = mesh.points.iter().map(|p| p[0]).fold(f64::NEG_INFINITY, f64::max);
    let radius = mesh.points.iter().map(|p| p[1].hypot(p[2])).fold(0.0, f64::max);
    let stress = |time: &str| -> Result<Vec<[f64; 3]>, Box<dyn Error>> {
        let field =
            Field::read(&run.join(time).join("stress"), mesh.volumes.len())?.ok_or("no field stress")?;
        let row = |face: usize| {
            let row = field.cells.row(mesh.owner[face]);
            [top - mesh.face_centres[face][0], -1e-3 * row[3], -1e-3 * row[0]]
        };
        Ok((side.first..side.first + side.count).map(row).collect())
    };
    let times = msdd_case::results::times(run, "")?;
    let name = |k: usize| times.get(k).map(|time| time.1.as_str()).ok_or("fewer than three times");
    let (rest, heated) = (stress(name(1)?)?, stress(name(times.len() - 1)?)?);
    let ratio = rest.iter().map(|x| x[1]).sum::<f64>() / rest.iter().map(|x| x[2]).sum::<f64>();
    // Friction of the walls, weight per volume [N/m3], pressure on top [Pa], rise of temperature [K]
    let text = std::fs::read_to_string(run.join("janssen"))?;
    let [friction, weight, load, heated_by] = text.split_whitespace().map(number).collect::<Vec<_>>()[..]
    else {
        return Err("silo/janssen needs four numbers".into());
    };
    let length = 2.0 * radius / (4.0 * friction * ratio);
    let janssen = |depth: f64| {
        let rest = (-depth / length).exp();
        1e-3 * ratio * (load * rest + weight * length * (1.0 - rest))
    };
    let curve = |all: &[[f64; 3]]| -> Points {
        let mut points: Points = all.iter().map(|x| (x[0], x[1])).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points
    };
    let deepest = rest.iter().map(|x| x[0]).fold(0.0, f64::max);
    let closed = (0..=60).map(|k| deepest * f64::from(k) / 60.0).map(|z| (z, janssen(z))).collect();
    let square = rest.iter().map(|x| (x[1] - janssen(x[0])).powi(2)).sum::<f64>() / rest.len() as f64;
    let error = square.sqrt() / janssen(deepest);
    let largest = |all: &[[f64; 3]]| all.iter().map(|x| x[1]).fold(0.0, f64::max);
    let times = largest(&heated) / largest(&rest);
    let title = format!(
        "Janssen within {:.0} % (rms) at rest; heated by {:.0} K: {times:.0} times",
        100.0 * error,
        heated_by
    );
    let list = vec![
        ("at rest".into(), series(curve(&rest), Style { size: 3, ..circle(2) })),
        ("Janssen".into(), line(closed, 0, Line::Dashed)),
        ("heated".into(), series(curve(&heated), Style { size: 3, ..Style::marker(1, Marker::Square) })),
    ];
    let [x, y] =
        ["depth below the surface [m]", "stress on the side [kPa]"].map(|label| from_data(label, false));
    Ok(plot_named(&title, &x, &y, list)?)
}

/// T with its 90 % band at three distances from the side of a cylinder, and DEM of the same packing.
fn band(run: &Path) -> Drawn {
    const BED: &str = "cases/beds/round-cycle";
    const RADIUS: f64 = 0.1;
    let dem = csv(&Path::new(BED).join("dem-1.csv"))?;
    let rows = csv(&run.join("bands.csv"))?;
    let [t, x, y, z] = ["time", "x", "y", "z"].map(|name| numbers(&rows, name));
    let own: Vec<usize> = (0..t.len()).filter(|&k| rows["quantity"][k] == "T").collect();
    let heights: Vec<f64> = own.iter().map(|&k| x[k]).collect();
    let middle =
        0.5 * (heights.iter().copied().fold(0.0, f64::max) + heights.iter().copied().fold(1.0, f64::min));
    let nearest = heights.iter().map(|x| (x - middle).abs()).fold(f64::INFINITY, f64::min);
    // Time, radius, value, low and high in the middle of the height
    let [value, low, high] = ["value", "low", "high"].map(|name| numbers(&rows, name));
    let points: Vec<[f64; 5]> = own
        .into_iter()
        .filter(|&k| (x[k] - middle).abs() < nearest + 1e-9)
        .map(|k| [t[k], y[k].hypot(z[k]), value[k], low[k], high[k]])
        .collect();
    let at = |radius: f64, column: usize| -> Points {
        let mut times: Vec<f64> = points.iter().map(|p| p[0]).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        let value = |time: f64| {
            let mut row: Points = points.iter().filter(|p| p[0] == time).map(|p| (p[1], p[column])).collect();
            row.sort_by(|a, b| a.0.total_cmp(&b.0));
            let pair = row.windows(2).find(|pair| pair[1].0 >= radius)?;
            let share = (radius - pair[0].0) / (pair[1].0 - pair[0].0);
            Some((time / 3600.0, pair[0].1 + share * (pair[1].1 - pair[0].1)))
        };
        times.into_iter().filter_map(value).collect()
    };
    let (mut list, mut inside, mut count) = (Vec::new(), 0, 0);
    for (distance, colour) in [("0.025", 1), ("0.05", 0), ("0.08", 2)] {
        let radius = RADIUS - number(distance);
        let hours = numbers(&dem, "time").into_iter().map(|t| t / 3600.0);
        let found: Points = hours.zip(numbers(&dem, &format!("T_{distance}"))).skip(1).collect();
        let [value, low, high] = [2, 3, 4].map(|column| at(radius, column));
        for (hour, t) in &found {
            let of = |curve: &Points| curve.iter().find(|p| (p.0 - hour).abs() < 1e-3).map(|p| p.1);
            if let (Some(low), Some(high)) = (of(&low), of(&high)) {
                (inside, count) = (inside + usize::from((low..=high).contains(t)), count + 1);
            }
        }
        list.push((
            format!("{:.0} mm from the side", 1e3 * number(distance)),
            line(value, colour, Line::Solid),
        ));
        list.push((
            if colour == 1 { "90 % band".into() } else { String::new() },
            line(low, colour, Line::Dotted),
        ));
        list.push((String::new(), line(high, colour, Line::Dotted)));
        let points = Style { size: 3, ..circle(colour) };
        list.push((if colour == 1 { "DEM".into() } else { String::new() }, series(found, points)));
    }
    let title = format!("{inside} of {count} values of DEM is inside the 90 % band");
    let [x, y] = ["time [h]", "T [K]"].map(|label| from_data(label, false));
    Ok(plot_named(&title, &x, &y, list)?)
}

/// T at three points of case HC, by discs and by the solver.
fn discs(summary: &Path) -> Drawn {
    let json: Value = serde_json::from_str(&std::fs::read_to_string(summary)?)?;
    let rows = |value: &Value| -> Vec<Vec<f64>> {
        let row = |row: &Value| row.as_array().into_iter().flatten().filter_map(Value::as_f64).collect();
        value.as_array().into_iter().flatten().map(row).collect()
    };
    let pairs = |value: &Value| rows(value).iter().map(|row| (row[0], row[1])).collect::<Points>();
    let worst = |kind: &str| {
        let errors = json["comparison"]["HC"][kind]["temperature"].as_array();
        errors.into_iter().flatten().filter_map(Value::as_f64).map(f64::abs).fold(0.0, f64::max)
    };
    let mut list = Vec::new();
    for (probe, colour) in [("P1", 1), ("P2", 0), ("P3", 2)] {
        let first = |name: &str| if probe == "P1" { name.to_string() } else { String::new() };
        let own = |kind: &str| pairs(&json[kind]["HC"]["probes"][probe]);
        list.push((probe.into(), line(own("moving"), colour, Line::Solid)));
        list.push((first("grains stay"), line(own("cases"), colour, Line::Dashed)));
        let found: Vec<Vec<f64>> =
            rows(&json["comparison"]["HC"]["discs"]["temperature"][probe]).into_iter().step_by(10).collect();
        list.push((
            first("15 000 discs, three packings"),
            Series {
                points: found.iter().map(|row| (row[0], row[1])).collect(),
                bars: found.iter().map(|row| row[2]).collect(),
                style: Style { size: 3, ..circle(colour) },
            },
        ));
    }
    let title = format!(
        "Case HC: error {:.1} % where grains move, {:.1} % where they stay",
        worst("grains_move"),
        worst("grains_stay")
    );
    let [x, y] = ["time [s]", "T [K]"].map(|label| from_data(label, false));
    Ok(plot_named(&title, &x, &y, list)?)
}
