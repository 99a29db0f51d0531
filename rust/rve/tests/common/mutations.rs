//! Random mutations of texts and files for fuzz tests; they are the same in every run. MSDD_FUZZ sets their number per
//! reader; a million takes minutes. Tests of other crates include this file, too.
#![allow(dead_code)] // each test uses a part

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

/// SplitMix64 (Steele, Lea, Flood 2014).
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    pub fn below(&mut self, end: usize) -> usize {
        (self.next() % end.max(1) as u64) as usize
    }
}

/// Replacements for a number or a value: limits of number types, of allowed ranges, and implausible values. None of
/// them makes a plan with so many packings that the test would take long.
pub const TOKENS: [&str; 33] = [
    "0",
    "-0.0",
    "1",
    "-1",
    "2",
    "3",
    "0.5",
    "0.12",
    "-0.5",
    "1e-3",
    "1e3",
    "1e-300",
    "5e-324",
    "1e300",
    "-1e300",
    "1.7976931348623157e308",
    "1e999",
    "4294967295",
    "4294967296",
    "9223372036854775807",
    "18446744073709551615",
    "-9223372036854775808",
    "NaN",
    "nan",
    "inf",
    "null",
    "true",
    "\"\"",
    "\"walls\"",
    "[]",
    "{}",
    "[0,0]",
    "",
];

/// Start and end of the first number in the text at or after a position.
fn number(text: &[u8], from: usize) -> Option<(usize, usize)> {
    let part = |byte: &u8| byte.is_ascii_digit() || b"+-.eE".contains(byte);
    let start = from + text.get(from..)?.iter().position(u8::is_ascii_digit)?;
    let start = start - text[..start].iter().rev().take_while(|byte| part(byte)).count();
    Some((start, start + text[start..].iter().take_while(|byte| part(byte)).count()))
}

/// Makes one to four changes: in a text mostly to its numbers, in other files to bits and runs of bytes.
pub fn mutated(bytes: &[u8], other: &[u8], is_text: bool, random: &mut Random) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for _ in 0..=random.below(4) {
        let (at, length) = (random.below(bytes.len()), random.below(40));
        let end = (at + length).min(bytes.len());
        match random.below(if is_text { 12 } else { 6 }) {
            0 => bytes.truncate(at),
            1 => drop(bytes.drain(at..end)),
            2 => {
                let copy = bytes[at..end].to_vec();
                bytes.splice(at..at, copy);
            }
            3 if !bytes.is_empty() => bytes[at] ^= 1 << random.below(8),
            4 => {
                let from = random.below(other.len());
                let part = other[from..(from + length).min(other.len())].to_vec();
                bytes.splice(at..end, part);
            }
            5 => bytes[at..end].fill(random.next() as u8),
            _ => {
                if let Some((start, end)) = number(&bytes, at) {
                    bytes.splice(start..end, TOKENS[random.below(TOKENS.len())].bytes());
                }
            }
        }
    }
    bytes
}

/// Number of mutations to try on a reader: that of MSDD_FUZZ, or else `usual`.
pub fn trials(usual: usize) -> usize {
    std::env::var("MSDD_FUZZ").ok().and_then(|text| text.parse().ok()).unwrap_or(usual)
}

/// Tries the inputs of a corpus and mutations of them. `check` returns whether an input was accepted, or an error when
/// the reader behaved wrongly; a panic counts as wrong, too. An input that a reader handled wrongly is written to
/// `folder`. Returns how many inputs were accepted.
pub fn fuzz(
    (name, folder): (&str, &Path),
    corpus: &[Vec<u8>],
    usual: usize,
    mut check: impl FnMut(&[u8]) -> Result<bool, String>,
) -> usize {
    let count = trials(usual);
    let mut random = Random(7);
    let mut accepted = 0;
    for trial in 0..corpus.len() + count {
        let input = match corpus.get(trial) {
            Some(bytes) => bytes.clone(),
            None => {
                let [one, other] = [0, 1].map(|_| &corpus[random.below(corpus.len())]);
                mutated(one, other, std::str::from_utf8(one).is_ok(), &mut random)
            }
        };
        let result =
            catch_unwind(AssertUnwindSafe(|| check(&input))).unwrap_or_else(|_| Err("panic".to_string()));
        match result {
            Ok(good) => accepted += usize::from(good),
            Err(why) => {
                let file = folder.join(format!("fuzz-{name}"));
                std::fs::write(&file, &input).expect("writable");
                panic!("trial {trial} of {name}: {why}; the input is in {}", file.display());
            }
        }
    }
    println!("{name}: {count} mutations, {accepted} accepted");
    accepted
}
