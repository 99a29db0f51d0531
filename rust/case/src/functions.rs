//! Functions of time and of temperature in a case's dictionaries.

use crate::dictionary::Token;
use msdd_beds::property::Property;
use msdd_beds::schedule::Schedule;

/// The numbers of an entry, and its first word if it has one; `None` for an entry with other words.
fn numbers(tokens: &[Token]) -> Option<(&str, Vec<f64>)> {
    let number = |token: &Token| token.text.parse::<f64>().ok();
    let (word, rest) = match tokens {
        [first, rest @ ..] if first.text != "(" && number(first).is_none() => (first.text.as_str(), rest),
        all => ("constant", all),
    };
    let is_bracket = |token: &&Token| ["(", ")"].contains(&token.text.as_str());
    let numbers: Option<Vec<f64>> = rest.iter().filter(|token| !is_bracket(token)).map(number).collect();
    Some((word, numbers?))
}

/// Rows of a table of pairs, or the value alone; `components`: of a value, `value`: what of it is meant.
fn rows(
    tokens: &[Token],
    components: usize,
    value: impl Fn(&[f64]) -> f64,
) -> Option<Result<f64, Vec<[f64; 2]>>> {
    let (word, numbers) = numbers(tokens)?;
    match word {
        "constant" | "uniform" if numbers.len() == components => Some(Ok(value(&numbers))),
        "table" if !numbers.is_empty() && numbers.len() % (1 + components) == 0 => {
            Some(Err(numbers.chunks(1 + components).map(|row| [row[0], value(&row[1..])]).collect()))
        }
        _ => None,
    }
}

/// A constant or a table over time of OpenFOAM; `None` for any other function.
pub fn schedule(tokens: &[Token], components: usize, value: impl Fn(&[f64]) -> f64) -> Option<Schedule> {
    rows(tokens, components, value).map(|found| found.map_or_else(Schedule::Table, Schedule::Constant))
}

/// A constant or a table over the temperature.
pub fn property(tokens: &[Token]) -> Option<Property> {
    rows(tokens, 1, |value| value[0]).map(|found| found.map_or_else(Property::Table, Property::Constant))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dictionary::Dictionary;
    use std::path::Path;

    #[test]
    fn constants_and_tables_are_read_and_nothing_else() {
        let read = |text: &str, components: usize| {
            let file = Dictionary::parse(Path::new("f"), &format!("f {text};")).unwrap();
            schedule(file.value("f").unwrap(), components, |value| value[components - 1])
        };
        let constant = |value| Some(Schedule::Constant(value));
        for text in ["3", "constant 3", "uniform 3"] {
            assert_eq!(read(text, 1), constant(3.0), "{text}");
        }
        assert_eq!(read("constant (0 0 2)", 3), constant(2.0));
        let table = Some(Schedule::Table(vec![[0.0, 1.0], [5.0, 2.0]]));
        assert_eq!(read("table ((0 1) (5 2))", 1), table);
        assert_eq!(read("table ((0 (0 0 1)) (5 (0 0 2)))", 3), table);
        for text in ["sine", "table (1 2 3)", "table ()", "constant", "csvFile \"a\"", "(1 2)"] {
            assert_eq!(read(text, 1), None, "{text}");
        }
    }
}
