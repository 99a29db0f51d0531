//! Dimensions in brackets: five or seven exponents, `[0 1 -2 0 0]`, or units, `[m s^-2]`.

use crate::dictionary::{Token, joined};

/// Exponents of kg, m, s, K, mol, A and cd.
type Exponents = [f64; 7];

/// Units with a name, in the order in which OpenFOAM lists them, and by what a number with them is multiplied.
const UNITS: [(&str, Exponents, f64); 20] = [
    ("kg", [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], 1.0),
    ("m", [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0], 1.0),
    ("s", [0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0], 1.0),
    ("K", [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0], 1.0),
    ("mol", [0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0], 1.0),
    ("A", [0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0], 1.0),
    ("Cd", [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], 1.0),
    ("Hz", [0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0], 1.0),
    ("N", [1.0, 1.0, -2.0, 0.0, 0.0, 0.0, 0.0], 1.0),
    ("Pa", [1.0, -1.0, -2.0, 0.0, 0.0, 0.0, 0.0], 1.0),
    ("J", [1.0, 2.0, -2.0, 0.0, 0.0, 0.0, 0.0], 1.0),
    ("W", [1.0, 2.0, -3.0, 0.0, 0.0, 0.0, 0.0], 1.0),
    ("area", [0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0], 1.0),
    ("volume", [0.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0], 1.0),
    ("density", [1.0, -3.0, 0.0, 0.0, 0.0, 0.0, 0.0], 1.0),
    ("acceleration", [0.0, 1.0, -2.0, 0.0, 0.0, 0.0, 0.0], 1.0),
    ("kinematicPressure", [0.0, 2.0, -2.0, 0.0, 0.0, 0.0, 0.0], 1.0),
    ("cm", [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0], 1e-2),
    ("mm", [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0], 1e-3),
    ("km", [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0], 1e3),
];
/// By how much equal exponents may differ.
const ROUND_OFF: f64 = 1e-10;

/// Exponents, and by what a number with these dimensions is multiplied.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dimensions {
    exponents: Exponents,
    pub factor: f64,
}

impl Dimensions {
    /// Reads what OpenFOAM reads, brackets included; none for anything else.
    pub fn read(tokens: &[Token]) -> Option<Self> {
        Self::read_text(&joined(tokens))
    }

    fn read_text(text: &str) -> Option<Self> {
        let inside = text.trim().strip_prefix('[')?.strip_suffix(']')?;
        let numbers: Option<Vec<f64>> = inside.split_whitespace().map(|word| word.parse().ok()).collect();
        if let Some(mut numbers) = numbers.filter(|numbers| !numbers.is_empty()) {
            if numbers.len() == 5 {
                numbers.extend([0.0, 0.0]);
            }
            return Some(Self { exponents: numbers.try_into().ok()?, factor: 1.0 });
        }
        let mut symbols = symbols(inside);
        symbols.reverse();
        let read = product(&mut symbols, 0)?;
        symbols.is_empty().then_some(read)
    }

    /// Whether these are the dimensions of a text such as `[ 0 1 0 0 0 0 0 ]`.
    pub fn are(&self, wanted: &str) -> bool {
        Self::read_text(wanted).is_some_and(|wanted| {
            let pairs = self.exponents.iter().zip(wanted.exponents);
            pairs.into_iter().all(|(a, b)| (a - b).abs() < ROUND_OFF)
        })
    }

    fn times(&mut self, other: Self, power: f64) {
        (0..7).for_each(|k| self.exponents[k] += power * other.exponents[k]);
        self.factor *= other.factor.powf(power);
    }
}

#[derive(Clone, Debug, PartialEq)]
enum Symbol {
    Unit(String),
    Number(f64),
    /// One of `* / ^ ( )`.
    Sign(char),
}

fn symbols(text: &str) -> Vec<Symbol> {
    let signs = ['*', '/', '^', '(', ')'];
    let spaced = signs.iter().fold(text.to_string(), |text, sign| text.replace(*sign, &format!(" {sign} ")));
    let symbol = |word: &str| match (word.parse(), word.chars().next()) {
        (Ok(number), _) => Symbol::Number(number),
        (_, Some(sign)) if signs.contains(&sign) => Symbol::Sign(sign),
        _ => Symbol::Unit(word.to_string()),
    };
    spaced.split_whitespace().map(symbol).collect()
}

/// Reads a product up to its end. `rest` has the next symbol at its end; `rank` is that of the sign in front of the product: a product
/// ends at the next sign that binds no stronger.
fn product(rest: &mut Vec<Symbol>, rank: u8) -> Option<Dimensions> {
    let mut all = Dimensions { exponents: [0.0; 7], factor: 1.0 };
    let mut after_symbol = false;
    while let Some(mut next) = rest.pop() {
        if after_symbol && !matches!(next, Symbol::Sign(_)) {
            rest.push(next);
            next = Symbol::Sign('*');
        }
        after_symbol = true;
        match next {
            Symbol::Unit(name) => {
                let (_, exponents, factor) = *UNITS.iter().find(|unit| unit.0 == name)?;
                all.times(Dimensions { exponents, factor }, 1.0);
            }
            Symbol::Number(number) => all.factor *= number,
            Symbol::Sign('(') => {
                let inside = product(rest, 0)?;
                (rest.pop()? == Symbol::Sign(')')).then_some(())?;
                all.times(inside, 1.0);
            }
            Symbol::Sign(')') => {
                rest.push(Symbol::Sign(')'));
                return Some(all);
            }
            Symbol::Sign(sign) => {
                let own = if sign == '^' { 3 } else { 2 };
                if own <= rank {
                    rest.push(Symbol::Sign(sign));
                    return Some(all);
                }
                let part = product(rest, own)?;
                match sign {
                    '^' => {
                        all.exponents = all.exponents.map(|x| x * part.factor);
                        all.factor = all.factor.powf(part.factor);
                    }
                    '/' => all.times(part, -1.0),
                    _ => all.times(part, 1.0),
                }
                after_symbol = false;
            }
        }
    }
    Some(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_and_units_are_read_as_openfoam_reads_them() {
        let is = |text: &str, wanted: &str| Dimensions::read_text(text).is_some_and(|read| read.are(wanted));
        assert!(is("[ 0 1 -2 0 0 ]", "[0 1 -2 0 0 0 0]"));
        assert!(is("[ K ]", "[0 0 0 1 0 0 0]") && is("[m s^-2]", "[0 1 -2 0 0 0 0]"));
        assert!(is("[ kg / m^3 ]", "[1 -3 0 0 0 0 0]") && is("[kg*m^-3]", "[1 -3 0 0 0 0 0]"));
        assert!(is("[W/(m K)]", "[1 1 -3 -1 0 0 0]") && is("[W/m/K]", "[1 1 -3 -1 0 0 0]"));
        assert!(is("[ Pa ]", "[1 -1 -2 0 0 0 0]") && !is("[Pa]", "[1 -1 -1 0 0 0 0]"));
        assert!(is("[m^2 s^-2 K^-1]", "[0 2 -2 -1 0 0 0]") && is("[(m/s)^2]", "[0 2 -2 0 0 0 0]"));
        assert_eq!(Dimensions::read_text("[mm]").map(|read| read.factor), Some(1e-3));
        for wrong in ["K", "[K", "[0 0 0 1]", "[0 0 0 1 0 0]", "[bar]", "[W/(m K]"] {
            assert_eq!(Dimensions::read_text(wrong), None, "{wrong}");
        }
        assert!(is("[]", "[0 0 0 0 0 0 0]"));
    }
}
