//! `--simd`: the instruction set of the kernels, the inner loops of the discrete element engine.

use crate::error::CliError;
use crate::named::parser;
use clap::Args;
use msdd_dem::Simd;

#[derive(Args)]
pub struct SimdArgument {
    /// Instruction set of the innermost loops. All give the same results, bit for bit, so neither states nor databases record
    /// which was used. Default: the widest of this machine.
    #[arg(long, value_name = "SET", value_parser = parser::<Simd>(&["scalar", "avx2", "avx512"]))]
    simd: Option<Simd>,
}

impl SimdArgument {
    /// Makes the kernels use the set from now on.
    pub fn apply(&self) -> Result<(), CliError> {
        let Some(set) = self.simd else { return Ok(()) };
        check(set, Simd::available)?;
        set.prefer();
        msdd_surrogate::kernel::limit(&format!("{set:?}").to_lowercase());
        Ok(())
    }
}

/// Refuses an instruction set that the machine does not have.
fn check(simd: Simd, available: impl Fn(Simd) -> bool) -> Result<(), CliError> {
    if available(simd) {
        return Ok(());
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
            check(Simd::Avx512, no_avx512).unwrap_err().to_string(),
            "--simd avx512: this machine does not have it, it has: scalar, avx2"
        );
        assert!(check(Simd::Avx2, no_avx512).is_ok());
    }
}
