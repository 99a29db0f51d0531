//! What the solver's C++ reads from dictionaries.

use crate::set::{Cell, Set};
use crate::sources::{all, firsts, strings, text};

/// A source without its comments, in which keys are named as well.
pub fn source(path: &str) -> String {
    without_comments(&text(path))
}

pub fn without_comments(text: &str) -> String {
    let mut found = String::new();
    let mut rest = text;
    while let Some(k) = rest.find(['/', '"']) {
        found.push_str(&rest[..k]);
        rest = &rest[k..];
        let skipped = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            rest.find("*/").map_or(rest.len(), |end| end + 2)
        } else if rest.starts_with('"') {
            let end = end_of_string(rest);
            found.push_str(&rest[..end]);
            end
        } else {
            found.push('/');
            1
        };
        rest = &rest[skipped..];
    }
    found + rest
}

/// Length of the string literal that the text begins with.
fn end_of_string(text: &str) -> usize {
    let mut escaped = false;
    for (k, c) in text.char_indices().skip(1) {
        match c {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            '"' => return k + 1,
            _ => (),
        }
    }
    text.len()
}

/// The keys that a `checkKeys` of the source allows, of the dictionary called so there.
pub fn allowed_keys(source: &str, dictionary: &str) -> Vec<String> {
    let lists = all(r"checkKeys\s*\(\s*([^,]+?),\s*\{([^}]*)\}\s*\)", source);
    lists.iter().filter(|list| list[1] == dictionary).flat_map(|list| strings(&list[2])).collect()
}

/// The keys of `wordList allowed ({...})`.
pub fn allowed_list(source: &str) -> Vec<String> {
    firsts(r"wordList allowed\s*\(\{([^}]*)\}\)", source).iter().flat_map(|list| strings(list)).collect()
}

/// The classes that a dictionary may select.
pub fn selectable(base: &str, sources: &[(String, String)]) -> Vec<String> {
    let pattern = format!(r"addToRunTimeSelectionTable\(\s*{base}\s*,\s*(\w+)\s*,");
    sources.iter().flat_map(|(_, text)| firsts(&pattern, text)).collect()
}

/// The words of an enumeration: `names` is the variable that lists them.
pub fn words_of(names: &str, source: &str) -> Vec<String> {
    let pattern = format!(r#"{names}\s*\(\{{((?:\s*\{{[^}}"]*"\w+"\s*\}},?)+)\s*\}}\)"#);
    firsts(&pattern, source).iter().flat_map(|list| strings(list)).collect()
}

/// Keys that are looked up.
pub fn lookups(source: &str) -> Vec<String> {
    let functions = "lookup|lookupOrDefault|getOrDefault|getOrAdd|get|getList|readIfPresent|readEntry|found|\
                     subDict|subOrEmptyDict|optionalSubDict|findDict|isDict|choice|positive|New";
    let simple = format!(r#"\b(?:{functions})(?:<[^>();]*>)?\s*\(\s*"(\w+)""#);
    let ranged = r#"\branged\s*\(\s*[^,"]+,\s*"(\w+)""#;
    let dimensioned = r#"\b\w+_?\s*\(\s*"(\w+)",\s*[\w/*\s]+,\s*\*this\s*\)"#;
    [simple.as_str(), ranged, dimensioned].iter().flat_map(|pattern| firsts(pattern, source)).collect()
}

/// Adds defaults and ranges that stand in the source as literals.
pub fn with_literals(mut set: Set, source: &str) -> Set {
    for found in all(r#"\branged\s*\(\s*[^,"]+,\s*"(\w+)"\s*,\s*([^,;]+),\s*([^,;]+),\s*([^,;)]+)\)"#, source)
    {
        let number = |k: usize| found[k].trim().parse::<f64>().ok();
        if let Some(default) = number(2) {
            set = set.with(&found[1], "default", Cell::Number(default));
        }
        if let (Some(low), Some(high)) = (number(3), number(4)) {
            set = set.with(&found[1], "allowed", Cell::Range(low, high));
        }
    }
    for key in firsts(r#"\bget<[^>();]*>\s*\(\s*"(\w+)""#, source) {
        set = set.with(&key, "default", Cell::Begins("required"));
    }
    for found in all(r#""(\w+)", FixedList<label, 2>\(\{(\d+), (\d+)\}\)"#, source) {
        set = set.with(&found[1], "default", Cell::Text(format!("({} {})", found[2], found[3])));
    }
    for found in all(r#"\bchoice\s*\(\s*"(\w+)"\s*,\s*\{([^}]*)\}"#, source) {
        let words = strings(&found[2]);
        set = set.with(&found[1], "default", Cell::Text(words[0].clone()));
        set = set.with(&found[1], "allowed", Cell::Words(words));
    }
    let literal = r#"(?:lookupOrDefault|getOrDefault)(?:<\w+>)?\s*\(\s*"(\w+)"\s*,\s*([^,()]+?)\s*\)"#;
    for found in all(literal, source) {
        if let Some(default) = literal_of(&found[2]) {
            set = set.with(&found[1], "default", default);
        }
    }
    for found in all(r#"Names\.getOrDefault\s*\(\s*"(\w+)"\s*,\s*[\w*]+\s*,\s*\w+::(\w+)\s*\)"#, source) {
        set = set.with(&found[1], "default", Cell::Text(found[2].clone()));
    }
    set
}

/// Units of quantities that the source gives with their dimensions, which have to be there.
pub fn with_units(mut set: Set, source: &str) -> Set {
    const UNITS: [(&str, &str); 6] = [
        ("dimDensity", "kg/m³"),
        ("dimPressure", "Pa"),
        ("dimPower/dimLength/dimTemperature", "W/(m K)"),
        ("dimSpecificHeatCapacity", "J/(kg K)"),
        ("dimless/dimTemperature", "1/K"),
        ("dimLength", "m"),
    ];
    for found in all(r#"(?:positive|\w+_)\s*\(\s*"(\w+)",\s*([\w/]+)(?:,\s*\*this)?\s*\)"#, source) {
        let unit = UNITS.iter().find(|(dimensions, _)| *dimensions == found[2]);
        let (_, unit) =
            unit.unwrap_or_else(|| panic!("{}: the unit of {} is not known here", found[1], found[2]));
        set = set.with(&found[1], "unit", Cell::Text((*unit).to_string()));
        set = set.with(&found[1], "default", Cell::Begins("required"));
    }
    set
}

fn literal_of(text: &str) -> Option<Cell> {
    match text {
        "true" => Some(Cell::Text("yes".to_string())),
        "false" => Some(Cell::Text("no".to_string())),
        _ => match text.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')) {
            Some(word) => Some(Cell::Text(word.to_string())),
            None => text.parse().ok().map(Cell::Number),
        },
    }
}

#[test]
fn comments_go_and_strings_stay() {
    let text = "a(\"x // y\"); // \"no\"\n/* \"no\" */ b('/') / c(\"\\\"q\\\"\");";
    assert_eq!(without_comments(text), "a(\"x // y\"); \n b('/') / c(\"\\\"q\\\"\");");
}

#[test]
fn every_way_of_a_lookup_is_seen() {
    let text = r#"
        dict.lookupOrDefault<word>("a", "none"); dict.getOrDefault<scalar>("b", 1e-3); dict.get<pointField>("c")
        granularProperties::ranged
        (
            dict_, "d", 5e-3, 1e-6, 0.1
        );
        names.getOrDefault("e", dict, kind::rigid); choice("f", {"x", "y"}); meanRadius_(positive("g", dimLength)),
        expansion_("h", dimless/dimTemperature, *this), Function1<scalar>::New("i", dict)
    "#;
    let mut found = lookups(text);
    found.sort();
    assert_eq!(found, ["a", "b", "c", "d", "e", "f", "g", "h", "i"]);
}
