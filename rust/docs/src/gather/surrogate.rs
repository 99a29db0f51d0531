//! How good the shipped models are on packings that their training never saw: what `msdd score` found.

use crate::error::DocsError;
use crate::gather::json::{INPUTS, Json};
use crate::gather::print::{decimals, grouped, or_none};
use crate::results::Section;
use std::path::Path;

/// Key, file of the scores, words.
const MODELS: [(&str, &str, &str); 2] = [
    ("increment", "score_increment.json", "law of the increments (shipped), periodic boxes"),
    ("paper", "score_paper.json", "the paper's network, boxes between walls"),
];
/// Strains of the tables, and the number of increments.
const STRAINS: [f64; 4] = [0.02, -0.02, 0.05, -0.05];
const INCREMENTS: f64 = 500.0;

/// # Errors
/// Scores that are missing or lack an entry.
pub fn section(root: &Path) -> Result<Section, DocsError> {
    let mut section = Section::default();
    let (mut one_step_rows, mut composed_rows) = (Vec::new(), Vec::new());
    for (key, file, words) in MODELS {
        let score = Json::read(root, &format!("{INPUTS}/{file}"))?.at("/0")?;
        let packings = grouped(score.number("/unseen/packings")?);
        let meaning = format!("packings that the training of the model '{key}' never saw");
        section.number(&format!("{key}.packings"), packings, "1", &meaning, "msdd score");
        one_step_rows.push(one_step(&score, words)?);
        composed_rows.extend(composed(&mut section, &score, key, words)?);
        if key == "increment" {
            way_back(&mut section, &score)?;
            means(&mut section, &score)?;
            paths(&mut section, &score)?;
        }
    }
    spheres(&mut section, &Json::read(root, &format!("{INPUTS}/score_spheres.json"))?)?;
    let cycling = along_paths(&Json::read(root, &format!("{INPUTS}/score_cycling.json"))?)?;
    let meaning = "rms errors of the law of spheres along paths of ten cycles, of all packings, one fifth of which its training never \
                   saw; no two of them are equal";
    section.add_table("spheres-law-cycling", meaning, "msdd score", &ALONG_COLUMNS, cycling);
    let poured = along_paths(&Json::read(root, &format!("{INPUTS}/score_poured.json"))?)?;
    let meaning = "rms errors of the law of spheres along the paths of beds that were poured, of all packings, \
                   most of which its training saw";
    section.add_table("spheres-law-poured", meaning, "msdd score", &ALONG_COLUMNS, poured);
    let columns = ["model", "porosity increment", "fabric increment", "conductivity", "stress"];
    let meaning = "coefficient of determination of one step on packings that training never saw";
    section.add_table("surrogate-one-step", meaning, "msdd score", &columns, one_step_rows);
    let columns = ["model", "strain", "K [%]", "stress [%]", "pressure [%]", "porosity", "fabric index"];
    let meaning = "rms error after a strain in 500 increments, packings that training never saw; in brackets what packings of equal \
                   state scatter by (noise floor)";
    section.add_table("surrogate-composed", meaning, "msdd score", &columns, composed_rows);
    Ok(section)
}

fn one_step(score: &Json, words: &str) -> Result<Vec<String>, DocsError> {
    let mut row = vec![words.to_string()];
    for name in ["delta_porosity", "delta_fabric_index", "conductivity", "stress"] {
        row.push(decimals(score.number(&format!("/unseen/{name}"))?, 4));
    }
    Ok(row)
}

fn composed(
    section: &mut Section,
    score: &Json,
    key: &str,
    words: &str,
) -> Result<Vec<Vec<String>>, DocsError> {
    let mut rows = Vec::new();
    for strain in STRAINS {
        let at = |entry: &Json| entry.maybe("/strain") == Some(strain);
        let what = format!("strain {strain} in {INCREMENTS}");
        let found =
            score.find("/composed", &what, |e| at(e) && e.maybe("/increments") == Some(INCREMENTS))?;
        let floor = score.find("/noise_floor", &what, at)?;
        let sign = format!("{:+.0}", 100.0 * strain);
        let mut row = vec![words.to_string(), format!("{sign} %")];
        for (name, factor, digits) in [
            ("conductivity", 100.0, 1),
            ("stress", 100.0, 1),
            ("pressure", 100.0, 1),
            ("porosity", 1.0, 4),
            ("fabric_index", 1.0, 4),
        ] {
            let value = decimals(factor * found.number(&format!("/{name}"))?, digits);
            let below = or_none(floor.maybe(&format!("/{name}")), |v| decimals(factor * v, digits));
            row.push(format!("{value} ({below})"));
            let meaning = format!("{words}: rms error of {name} after {sign} % in 500 increments");
            let unit = if factor > 1.0 { "%" } else { "1" };
            let strain_key = sign.replace('+', "plus").replace('-', "minus");
            section.number(&format!("{key}.{strain_key}.{name}"), value, unit, &meaning, "msdd score");
        }
        rows.push(row);
    }
    Ok(rows)
}

/// The largest errors of means over 30 packings, over all strains.
fn means(section: &mut Section, score: &Json) -> Result<(), DocsError> {
    let composed = score.list("/composed")?;
    let many = composed.iter().filter(|entry| entry.maybe("/increments") == Some(INCREMENTS));
    let many: Vec<&Json> = many.collect();
    for (entry, words) in [("mean_conductivity", "conductivity"), ("mean_pressure", "pressure")] {
        let values =
            many.iter().map(|one| one.number(&format!("/{entry}"))).collect::<Result<Vec<f64>, _>>()?;
        let worst = decimals(100.0 * values.into_iter().fold(0.0, f64::max), 1);
        let meaning = format!(
            "largest error of the mean {words} of 30 packings after a strain of up to 5 % in 500 increments"
        );
        section.number(&format!("increment.{entry}"), worst, "%", &meaning, "msdd score");
    }
    Ok(())
}

/// Strains of the database that are taken back.
fn way_back(section: &mut Section, score: &Json) -> Result<(), DocsError> {
    let mut rows = Vec::new();
    for way in score.list("/way_back")? {
        let error = |name: &str, factor: f64, digits: usize| {
            way.number(&format!("/errors/{name}")).map(|value| decimals(factor * value, digits))
        };
        rows.push(vec![
            format!("{:+.0} %", -100.0 * way.number("/errors/strain")?),
            grouped(way.number("/errors/ramps")?),
            error("conductivity", 100.0, 1)?,
            error("stress", 100.0, 1)?,
            error("fabric_index", 1.0, 3)?,
        ]);
    }
    let columns = ["back from about", "ramps", "K [%]", "stress [%]", "fabric index"];
    let meaning = "rms error after the way back to the packed radii in 500 increments";
    section.add_table("surrogate-way-back", meaning, "msdd score", &columns, rows);
    Ok(())
}

/// Errors along paths of strain, by kind of path and size of the boxes.
fn paths(section: &mut Section, score: &Json) -> Result<(), DocsError> {
    let (mut rows, mut sums) = (Vec::new(), [0.0; 2]);
    for kind in score.list("/paths")? {
        let counts = [kind.number("/paths")?, kind.number("/states")?];
        sums = [sums[0] + counts[0], sums[1] + counts[1]];
        let mut row = vec![format!("`{}`", kind.text("/name")?), grouped(kind.number("/discs")?)];
        row.extend(counts.map(grouped));
        for name in ["pressure", "deviator", "conductivity"] {
            row.push(decimals(100.0 * kind.number(&format!("/{name}"))?, 1));
        }
        rows.push(row);
    }
    for (key, sum, what) in
        [("paths", sums[0], "paths of strain"), ("increments", sums[1], "increments on paths of strain")]
    {
        let meaning = format!("{what} of packings that the training of the model 'increment' never saw");
        section.number(&format!("increment.{key}"), grouped(sum), "1", &meaning, "msdd score");
    }
    let columns = ["path", "discs", "paths", "increments", "pressure [%]", "deviator [%]", "K [%]"];
    let meaning = "rms error along paths of strain of packings that training never saw: pressure and deviator over the mean pressure of \
                   the path, mean conductivity over that of the state";
    section.add_table("surrogate-paths", meaning, "msdd score", &columns, rows);
    Ok(())
}

/// Errors of the law of spheres along paths, as they are called in files.
const ALONG: [&str; 4] = ["pressure", "deviator", "contact", "gas"];

const ALONG_COLUMNS: [&str; 7] =
    ["path", "paths", "states", "pressure [%]", "deviator [%]", "K by contacts [%]", "K by gas [%]"];

/// Rows of a table of errors along paths; scatter, where there is one, in brackets.
fn along_paths(scores: &Json) -> Result<Vec<Vec<String>>, DocsError> {
    let mut rows = Vec::new();
    for kind in scores.list("/0")? {
        let name = format!("`{}`", kind.text("/name")?);
        let mut row = vec![name, grouped(kind.number("/paths")?), grouped(kind.number("/states")?)];
        for error in ALONG {
            let scatter = kind.maybe(&format!("/noise/{error}"));
            let scatter = or_none(scatter, |value| decimals(100.0 * value, 1));
            let along =
                or_none(kind.at(&format!("/along/{error}"))?.maybe(""), |value| decimals(100.0 * value, 1));
            row.push(format!("{along} ({scatter})"));
        }
        rows.push(row);
    }
    Ok(rows)
}

/// Rows of a table of errors along the paths of packings with which others were made and strained equally; scatter in brackets.
fn along_alike(scores: &Json) -> Result<Vec<Vec<String>>, DocsError> {
    let mut rows = Vec::new();
    for kind in scores.list("/0")? {
        let percent = |name: String| kind.maybe(&name).map(|value| decimals(100.0 * value, 1));
        let cell = |error: &&str| {
            Some(format!(
                "{} ({})",
                percent(format!("/beside_noise/{error}"))?,
                percent(format!("/noise/{error}"))?
            ))
        };
        let cells: Vec<String> = ALONG.iter().filter_map(cell).collect();
        if cells.len() == ALONG.len() {
            rows.push([vec![format!("`{}`", kind.text("/name")?)], cells].concat());
        }
    }
    Ok(rows)
}

/// The law of spheres along paths, compared with the scatter between packings that were made and strained equally; and of known states.
fn spheres(section: &mut Section, scores: &Json) -> Result<(), DocsError> {
    let mut known = Vec::new();
    for kind in scores.list("/0")? {
        let percent = |name: &str| -> Result<String, DocsError> {
            Ok(or_none(kind.at(name)?.maybe(""), |value| decimals(100.0 * value, 1)))
        };
        let mut row = vec![format!("`{}`", kind.text("/name")?)];
        for error in ["/contact_of_state", "/direction", "/gas_of_state"] {
            row.push(percent(error)?);
        }
        for error in ALONG {
            row.push(percent(&format!("/of_stress_alone/{error}"))?);
        }
        known.push(row);
    }
    let meaning = "rms errors of the law of spheres along paths of strain of packings that its training never saw; in brackets the \
                   scatter between packings that were made and strained equally";
    section.add_table("spheres-law", meaning, "msdd score", &ALONG_COLUMNS, along_paths(scores)?);
    let columns = ["path", "pressure [%]", "deviator [%]", "K by contacts [%]", "K by gas [%]"];
    let meaning = "rms errors of the law of spheres along the paths of all packings with which others were made and strained equally; in \
                   brackets the scatter between those";
    section.add_table("spheres-law-alike", meaning, "msdd score", &columns, along_alike(scores)?);
    let columns = [
        "path",
        "K by contacts of the state [%]",
        "its direction [%]",
        "K by gas of the state [%]",
        "pressure [%]",
        "deviator [%]",
        "K by contacts [%]",
        "K by gas [%]",
    ];
    let meaning = "rms errors of conductivities of known states, and errors along paths where solid fraction, stress and mobilised \
                   friction alone are known at the start";
    section.add_table("spheres-law-known", meaning, "msdd score", &columns, known);
    Ok(())
}
