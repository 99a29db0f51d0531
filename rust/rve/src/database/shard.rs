//! Parts of a plan, for several processes or machines.

use std::fmt;
use std::str::FromStr;

/// A part of a plan: every `count`-th packing, beginning with the `number`-th; 1/1 is the whole plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    number: i64,
    count: i64,
}

impl Default for Shard {
    fn default() -> Self {
        Self { number: 1, count: 1 }
    }
}

impl Shard {
    /// Whether the packing of this index belongs to the shard.
    pub fn holds(self, packing: i64) -> bool {
        packing.rem_euclid(self.count) == self.number - 1
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.count)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once('/').and_then(|(a, b)| Some((a.parse().ok()?, b.parse().ok()?)));
        match parts {
            Some((number, count)) if number >= 1 && number <= count => Ok(Self { number, count }),
            _ => Err(format!("'{text}', allowed: NUMBER/COUNT with 1 <= NUMBER <= COUNT, as 3/16")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_cover_a_plan_once() {
        let shards: Vec<Shard> = ["1/3", "2/3", "3/3"].iter().map(|text| text.parse().unwrap()).collect();
        for packing in 0..10 {
            assert_eq!(shards.iter().filter(|shard| shard.holds(packing)).count(), 1);
        }
        assert_eq!(shards[2].to_string(), "3/3");
        for bad in ["0/3", "4/3", "3", "a/b", "1/"] {
            assert!(bad.parse::<Shard>().unwrap_err().contains("allowed: NUMBER/COUNT"), "{bad}");
        }
    }
}
