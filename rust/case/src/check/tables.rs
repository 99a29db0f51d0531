//! Checks the functions of a file that depend on a temperature or a time, in the forms of OpenFOAM's Function1.

use super::finding::Findings;
use crate::dictionary::{Dictionary, Entry, Token, joined};

/// Forms whose values stand behind their name: `key table ((0 1) (2 3));`.
const IN_LINE: [&str; 3] = ["constant", "polynomial", "table"];
const WAVE: &[&str] = &["amplitude", "frequency", "scale", "level"];
const RAMP: &[&str] = &["duration"];
/// The other forms that are read here, and the entries that each needs.
const WITH_ENTRIES: [(&str, &[&str]); 10] = [
    ("sine", WAVE),
    ("square", WAVE),
    ("scale", &["scale", "value"]),
    ("tableFile", &["file"]),
    ("csvFile", &["file", "nHeaderLine", "refColumn", "componentColumns", "mergeSeparators"]),
    ("linearRamp", RAMP),
    ("quadraticRamp", RAMP),
    ("halfCosineRamp", RAMP),
    ("quarterSineRamp", RAMP),
    ("quarterCosineRamp", RAMP),
];
/// Forms of a temperature of a wall in OpenFOAM v1912, with the two of a field.
const OF_WALL: [&str; 15] = [
    "constant",
    "csvFile",
    "mappedFile",
    "one",
    "polynomial",
    "sampled",
    "scale",
    "sine",
    "square",
    "table",
    "tableFile",
    "uniformValue",
    "zero",
    "uniform",
    "nonuniform",
];
/// Keys that hold words, which may be equal to that of a form.
const WORDS: [&str; 4] = ["type", "name", "mode", "model"];
/// Number of times at which a function is looked at.
const SAMPLES: u32 = 20;

/// Checks every function in a dictionary and in those inside of it: `key table ((0 1) (2 3));`, `key table; keyCoeffs { ... }` and
/// `key { type sine; ... }`. OpenFOAM refuses a table whose first column does not rise, and one without rows.
pub fn check(file: &str, dictionary: &Dictionary, found: &mut Findings) {
    let is_table = dictionary.text("type").is_ok_and(|kind| kind == "table");
    if dictionary.text("type").is_ok_and(|kind| kind == "uniformFixedValue") {
        check_wall(file, dictionary, found);
    }
    for key in dictionary.keys() {
        let place = dictionary.path_of(&key.text);
        match dictionary.get_any(&key.text) {
            Some(Entry::Dictionary(inner)) => {
                check_braces([file, &place], &key.text, inner, found);
                check(file, inner, found);
            }
            Some(Entry::Value(tokens)) => {
                if let Some(form) = tokens.first().filter(|_| !WORDS.contains(&key.text.as_str())) {
                    check_coefficients(file, dictionary, [&key.text, &form.text], tokens.len() == 1, found);
                }
                let rows = match tokens.as_slice() {
                    [word, rows @ ..] if word.text == "table" || word.text == "polynomial" => rows,
                    rows if is_table && key.text == "values" => rows,
                    _ => continue,
                };
                let rises = tokens.first().is_none_or(|word| word.text != "polynomial");
                check_rows([file, &place], rows, rises, found);
            }
            None => {}
        }
    }
}

/// Reports a temperature over time that is missing, or in a form that walls do not know: ramps, for example.
fn check_wall(file: &str, patch: &Dictionary, found: &mut Findings) {
    let form = match patch.get("uniformValue") {
        Some(Entry::Dictionary(own)) => own.text("type").ok(),
        Some(Entry::Value(tokens)) => tokens.first().map(|token| token.text.clone()),
        None => Some("missing".to_string()),
    };
    let known = |form: &str| OF_WALL.contains(&form) || form.parse::<f64>().is_ok() || form == "(";
    if let Some(form) = form.filter(|form| !known(form)) {
        let allowed = format!("a number, {}", OF_WALL[..13].join(", "));
        found.error([file, &patch.path_of("uniformValue")], &form, &allowed, "");
    }
}

/// OpenFOAM v1912 looks for the values of some forms under the name of the key, even in a dictionary of that name.
fn check_braces(place: [&str; 2], key: &str, own: &Dictionary, found: &mut Findings) {
    let kind = own.text("type").unwrap_or_default();
    // A surrogate may be constant, too
    if IN_LINE.contains(&kind.as_str()) && own.get(key).is_none() && key != "surrogate" {
        let allowed = format!("{key} {kind} ...; without braces");
        let advice = "OpenFOAM v1912 does not read this form in braces";
        found.error(place, &format!("{{ type {kind}; ... }}"), &allowed, advice);
    }
    needs(place[0], own, &kind, found);
}

/// A form that is given by a word; `alone`: without anything behind it. The dictionary `<key>Coeffs` counts wherever it is there, and
/// OpenFOAM v1912 looks in it for the values of some forms under the name of the key, too.
fn check_coefficients(
    file: &str,
    dictionary: &Dictionary,
    [key, form]: [&str; 2],
    alone: bool,
    found: &mut Findings,
) {
    let own = dictionary.dictionary_at(&format!("{key}Coeffs"));
    if !IN_LINE.contains(&form) {
        if alone {
            needs(file, own.unwrap_or(dictionary), form, found);
        }
        return;
    }
    let missing = match own {
        Ok(own) => own.get(key).is_none().then_some(own),
        Err(_) => None,
    };
    let advice = format!("OpenFOAM v1912 reads the values of this form under the name '{key}' alone");
    if let Some(own) = missing {
        found.error([file, &own.path_of(key)], "missing", &format!("{form} and its values"), &advice);
    } else if own.is_err() && alone {
        found.error([file, &dictionary.path_of(key)], form, &format!("{form} and its values"), &advice);
    }
}

/// Reports the entries that a form needs and does not have.
fn needs(file: &str, own: &Dictionary, form: &str, found: &mut Findings) {
    let Some((_, entries)) = WITH_ENTRIES.iter().find(|(name, _)| *name == form) else { return };
    for entry in entries.iter().filter(|entry| own.get_any(entry).is_none()) {
        let advice = format!("A function of type {form} needs {}", entries.join(", "));
        found.error([file, &own.path_of(entry)], "missing", "a value", &advice);
    }
}

/// Form and values of a function, wherever they stand; none for forms whose values do not stand behind their name.
fn parts<'a>(dictionary: &'a Dictionary, key: &str) -> Option<(String, &'a [Token])> {
    let (form, tokens) = match dictionary.get(key)? {
        Entry::Dictionary(own) => (own.text("type").ok()?, own.value(key).ok()?),
        Entry::Value(tokens) if tokens.len() == 1 && tokens[0].text.parse::<f64>().is_ok() => {
            return Some(("constant".to_string(), tokens));
        }
        Entry::Value(tokens) => {
            let own = dictionary.dictionary_at(&format!("{key}Coeffs"));
            let values = own.map_or(Ok(tokens.as_slice()), |own| own.value(key));
            (tokens.first()?.text.clone(), values.ok()?)
        }
    };
    // OpenFOAM skips the word in front of the values
    let values = tokens.get(1..).filter(|_| IN_LINE.contains(&form.as_str()))?;
    Some((form, values))
}

fn check_rows(place: [&str; 2], tokens: &[Token], rises: bool, found: &mut Findings) {
    let rows = rows(tokens);
    if rows.is_empty() && tokens.last().is_some_and(|token| token.text == ")") {
        found.error(place, &joined(tokens), "at least one row", "");
    }
    let column: Vec<f64> = rows.iter().filter_map(|row| row.first().copied()).collect();
    if let Some(pair) = column.windows(2).find(|pair| rises && pair[0] >= pair[1]) {
        let allowed = format!("a first column that rises; {} stands before {}", pair[0], pair[1]);
        found.error(place, &joined(tokens), &allowed, "");
    }
}

/// The numbers in each row of `( ( 0 1 ) ( 2 ( 3 4 5 ) ) )`, also with the number of rows in front.
fn rows(tokens: &[Token]) -> Vec<Vec<f64>> {
    let (mut depth, mut rows) = (0, Vec::<Vec<f64>>::new());
    for token in tokens {
        match token.text.as_str() {
            "(" => {
                depth += 1;
                if depth == 2 {
                    rows.push(Vec::new());
                }
            }
            ")" => depth -= 1,
            text if depth >= 2 => {
                if let (Some(row), Ok(number)) = (rows.last_mut(), text.parse()) {
                    row.push(number);
                }
            }
            _ => {}
        }
    }
    rows
}

/// Values that the function `key` takes between two times \[s\]: all of a table, those of a polynomial at some times. None where they are not
/// known: they stand in another file, or the form is another one.
pub fn values(dictionary: &Dictionary, key: &str, times: Option<[f64; 2]>) -> Option<Vec<f64>> {
    let (form, list) = parts(dictionary, key)?;
    match (form.as_str(), list) {
        ("constant", [number]) => Some(vec![number.text.parse().ok()?]),
        ("table", list) => rows(list).iter().map(|row| row.get(1).copied()).collect(),
        ("polynomial", list) => {
            let ([from, to], terms) = (times?, rows(list));
            let terms: Option<Vec<[f64; 2]>> = terms.into_iter().map(|term| term.try_into().ok()).collect();
            let terms = terms?;
            let at = |time: f64| terms.iter().map(|[factor, power]| factor * time.powf(*power)).sum();
            let share = |k| f64::from(k) / f64::from(SAMPLES);
            Some((0..=SAMPLES).map(|k| at(from + share(k) * (to - from))).collect())
        }
        _ => None,
    }
}

/// Value of the function `key` at a temperature or time: linear between the rows of a table, constant beyond. None where it is not known.
pub fn at(dictionary: &Dictionary, key: &str, x: f64) -> Option<f64> {
    let (form, list) = parts(dictionary, key)?;
    if form != "table" {
        return values(dictionary, key, Some([x, x]))?.first().copied();
    }
    let pairs: Option<Vec<[f64; 2]>> = rows(list).into_iter().map(|row| row.try_into().ok()).collect();
    let pairs = pairs?;
    let next = pairs.iter().position(|[there, _]| *there >= x);
    match next {
        None => pairs.last().map(|[_, value]| *value),
        Some(0) => pairs.first().map(|[_, value]| *value),
        Some(k) => {
            let ([from, low], [to, high]) = (pairs[k - 1], pairs[k]);
            Some(low + (high - low) * (x - from) / (to - from))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn lines(text: &str) -> Vec<String> {
        let file = Dictionary::parse(Path::new("0/T"), text).unwrap();
        let mut found = Findings::default();
        check("0/T", &file, &mut found);
        found.0.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn first_columns_rise() {
        let good =
            "k table ((300 1) (400 0.5)); walls { top { pressure { type table; pressure table 2 ((0 9) (1 8)); }
            displacement table ((0 (3 2 1)) (1 (0 0 0))); } } t uniform 3; values ((3 1) (2 1));";
        assert_eq!(lines(good), Vec::<String>::new());
        let bad = lines(&good.replace("(400 0.5)", "(200 0.5)"));
        assert_eq!(
            bad,
            [
                "error: 0/T: k = ( ( 300 1 ) ( 200 0.5 ) ), allowed: a first column that rises; 300 stands before 200"
            ]
        );
        assert!(
            lines(&good.replace("(1 8)", "(0 8)"))[0]
                .starts_with("error: 0/T: walls/top/pressure/pressure = 2 (")
        );
        assert!(lines(&good.replace("(1 (0", "(-1 (0"))[0].contains("walls/top/displacement = "));
    }

    #[test]
    fn what_openfoam_does_not_read_is_refused() {
        assert_eq!(
            lines("heatCapacity { type table; values ((0 1) (9 2)); }"),
            [
                "error: 0/T: heatCapacity = { type table; ... }, allowed: heatCapacity table ...; without braces. OpenFOAM v1912 does not read this form in braces"
            ]
        );
        assert!(lines("a { uniformValue { type constant; value 3; } }")[0].contains("a/uniformValue = {"));
        for good in [
            "surrogate { type constant; }",
            "k { type tableFile; file \"k\"; }",
            "k { type table; k table ((0 1) (2 3)); }",
            "k table; kCoeffs { k table ((0 1) (2 3)); }",
            "k sine; kCoeffs { amplitude 1; frequency 1; scale 3; level 100; }",
            "k sine; amplitude 1; frequency 1; scale 3; level 100;",
            "k { type scale; scale { type linearRamp; duration 3; } value 3; }",
            "a { type zeroGradient; name table; mode constant; }",
            "k polynomial ((9 0) (-1 1));",
        ] {
            assert_eq!(lines(good), Vec::<String>::new());
        }
        let bad = lines("k table; kCoeffs { values ((0 1) (2 3)); }");
        assert_eq!(
            bad,
            [
                "error: 0/T: kCoeffs/k = missing, allowed: table and its values. OpenFOAM v1912 reads the values of this form under the name 'k' alone"
            ]
        );
        for (bad, wanted) in [
            ("k table ((0 1)); kCoeffs { x 1; }", "kCoeffs/k = missing, allowed: table and its values"),
            ("k table; kCoeffs { k table ((1 1) (0 3)); }", "kCoeffs/k = ( ( 1 1 )"),
            ("k polynomial;", "k = polynomial, allowed: polynomial and its values"),
            ("k square; kCoeffs { amplitude 1; frequency 1; level 9; }", "kCoeffs/scale = missing"),
            ("k { type linearRamp; start 1; }", "k/duration = missing"),
            (
                "k csvFile; nHeaderLine 1; refColumn 0; componentColumns (1); mergeSeparators no;",
                "file = missing",
            ),
        ] {
            let found = lines(bad);
            assert!(found.len() == 1 && found[0].starts_with(&format!("error: 0/T: {wanted}")), "{found:?}");
        }
        for empty in ["k table ();", "k table 0 ( );", "k polynomial ();"] {
            let found = lines(empty);
            assert!(found.len() == 1 && found[0].contains("allowed: at least one row"), "{found:?}");
        }
    }

    #[test]
    fn walls_know_some_forms() {
        let wall =
            |value: &str| lines(&format!("boundaryField {{ left {{ type uniformFixedValue; {value} }} }}"));
        for good in ["constant 3", "3", "uniform 3", "zero", "table ((0 1))"] {
            assert_eq!(wall(&format!("uniformValue {good};")), Vec::<String>::new());
        }
        let start = "error: 0/T: boundaryField/left/uniformValue = ";
        for (bad, wanted) in [
            (
                "uniformValue linearRamp; uniformValueCoeffs { duration 3; }",
                "linearRamp, allowed: a number, constant, csvFile",
            ),
            ("uniformValue { type tabel; file \"w\"; }", "tabel, allowed: "),
            ("uniformvalue 3;", "missing, allowed: "),
        ] {
            let found = wall(bad);
            assert!(found.len() == 1 && found[0].starts_with(&format!("{start}{wanted}")), "{found:?}");
        }
    }

    #[test]
    fn a_table_is_linear_between_its_rows_and_constant_beyond() {
        let at = |text: &str, x: f64| {
            let file = Dictionary::parse(Path::new("0/T"), &format!("k {text};")).unwrap();
            at(&file, "k", x)
        };
        let table = "table 2((300 3)(400 1))";
        assert_eq!([250.0, 300.0, 350.0, 450.0].map(|x| at(table, x)), [3.0, 3.0, 2.0, 1.0].map(Some));
        assert_eq!(at("polynomial ((2 0) (0.5 1))", 4.0), Some(4.0));
        assert_eq!([at("constant 3", 1.0), at("3", 1.0)], [Some(3.0); 2]);
        assert_eq!([at("csvFile", 1.0), at("table ()", 1.0)], [None; 2]);
    }

    #[test]
    fn values_are_those_over_time_alone() {
        let of = |text: &str| {
            let file = Dictionary::parse(Path::new("0/T"), &format!("k {text}")).unwrap();
            values(&file, "k", Some([0.0, 10.0]))
        };
        assert_eq!(of("constant 3;"), Some(vec![3.0]));
        for table in [
            "table 3((0 300)(1 310)(2 320));",
            "table; kCoeffs { k table ((0 300)(1 310)(2 320)); }",
            "table (); kCoeffs { k any ((0 300)(1 310)(2 320)); }",
            "{ type table; k table ((0 300)(1 310)(2 320)); }",
        ] {
            assert_eq!(of(table), Some(vec![300.0, 310.0, 320.0]), "{table}");
        }
        let falls = of("polynomial 2 ((350 0) (-0.5 1));").unwrap();
        assert_eq!([falls[0], falls[10], falls[20]], [350.0, 347.5, 345.0]);
        for unknown in [
            "sine;",
            "csvFile;",
            "{ type sine; level 3; }",
            "{ type scale; value 400; }",
            "table; kCoeffs { values ((0 1)); }",
        ] {
            assert_eq!(of(unknown), None, "{unknown}");
        }
    }
}
