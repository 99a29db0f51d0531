//! `--simd`: the instruction set of the kernels, the inner loops of the discrete element engine.

use crate::error::CliError;
use clap::{Args, ValueEnum};
use msdd_dem::Simd;

#[derive(Args)]
pub struct SimdArgument {
    /// Instruction set of the innermost loops. All give the same results, bit for bit, so neither states nor databases record
    /// which was used. Default: the widest of this machine.
    #[arg(long, value_enum, value_name = "SET")]
    simd: Option<SimdName>,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum SimdName {
    Scalar,
    Avx2,
    Avx512,
}

impl SimdArgument {
    /// Makes the kernels use the set from now on.
    pub fn apply(&self) -> Result<(), CliError> {
        let Some(name) = self.simd else { return Ok(()) };
        let set = set(name, Simd::available)?;
        set.prefer();
        msdd_surrogate::kernel::limit(&format!("{set:?}").to_lowercase());
        Ok(())
    }
}

/// The instruction set of that name; refused when the machine does not have it.
fn set(name: SimdName, available: impl Fn(Simd) -> bool) -> Result<Simd, CliError> {
    let simd = match name {
        SimdName::Scalar => Simd::Scalar,
        SimdName::Avx2 => Simd::Avx2,
        SimdName::Avx512 => Simd::Avx512,
    };
    if available(simd) {
        return Ok(simd);
    }
    let lower = |simd: Simd| format!("{simd:?}").to_lowercase();
    let there: Vec<String> = Simd::ALL.into_iter().filter(|&set| available(set)).map(lower).collect();
    let (wanted, there) = (lower(simd), there.join(", "));
    Err(CliError::Message(format!("--simd {wanted}: this machine does not have it, it has: {there}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_set_is_refused_with_those_that_are_there() {
        let no_avx512 = |simd| simd != Simd::Avx512;
        assert_eq!(
            set(SimdName::Avx512, no_avx512).unwrap_err().to_string(),
            "--simd avx512: this machine does not have it, it has: scalar, avx2"
        );
        assert_eq!(set(SimdName::Avx2, no_avx512).unwrap(), Simd::Avx2);
    }
}
