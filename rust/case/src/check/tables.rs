//! Checks the tables of a file, whose first column must rise: temperatures, or times.

use super::finding::Findings;
use crate::dictionary::{Dictionary, Entry, Token, joined};

/// Checks every table in a dictionary and in those inside of it: `key table ((0 1) (2 3));`, and `key { type table; values (...); }`.
/// OpenFOAM refuses a table whose first column does not rise.
pub fn check(file: &str, dictionary: &Dictionary, found: &mut Findings) {
    let is_table = dictionary.text("type").is_ok_and(|kind| kind == "table");
    for key in dictionary.keys() {
        match dictionary.get_any(&key.text) {
            Some(Entry::Dictionary(inner)) => check(file, inner, found),
            Some(Entry::Value(tokens)) => {
                let rows = match tokens.as_slice() {
                    [word, rows @ ..] if word.text == "table" => rows,
                    rows if is_table && key.text == "values" => rows,
                    _ => continue,
                };
                check_rows([file, &dictionary.path_of(&key.text)], rows, found);
            }
            None => {}
        }
    }
}

fn check_rows(place: [&str; 2], rows: &[Token], found: &mut Findings) {
    let column = first_column(rows);
    if let Some(pair) = column.windows(2).find(|pair| pair[0] >= pair[1]) {
        let allowed = format!("a first column that rises; {} stands before {}", pair[0], pair[1]);
        found.error(place, &joined(rows), &allowed, "");
    }
}

/// The first number of each row of `( ( 0 1 ) ( 2 ( 3 4 5 ) ) )`, also with the number of rows in front.
fn first_column(rows: &[Token]) -> Vec<f64> {
    let (mut depth, mut column) = (0, Vec::new());
    for pair in rows.windows(2) {
        match pair[0].text.as_str() {
            "(" => depth += 1,
            ")" => depth -= 1,
            _ => {}
        }
        if depth == 2 && pair[0].text == "(" {
            column.extend(pair[1].text.parse::<f64>());
        }
    }
    column
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
            "k table ((300 1) (400 0.5)); walls { top { pressure { type table; values 2 ((0 9) (1 8)); }
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
                .starts_with("error: 0/T: walls/top/pressure/values = 2 (")
        );
        assert!(lines(&good.replace("(1 (0", "(-1 (0"))[0].contains("walls/top/displacement = "));
    }
}
