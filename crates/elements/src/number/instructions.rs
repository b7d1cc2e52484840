//! The instructions that kernels are run with: the widest that this processor has, or those that the environment names.

use std::sync::OnceLock;

#[cfg(target_arch = "x86_64")]
use pulp::x86::{V3, V4};

/// The variable that names them: `fallback`, `avx2` or `avx512`. Tests compare the three with it.
const VARIABLE: &str = "FEM_INSTRUCTIONS";

/// A set of instructions, with pulp's proof that the processor has them.
#[derive(Clone, Copy, Debug)]
pub enum Instructions {
    /// Those of every processor.
    Fallback,
    /// 16 registers of 256 bits, with fused multiplication and addition.
    #[cfg(target_arch = "x86_64")]
    Avx2(V3),
    /// The same with 32 registers, and registers of 512 bits.
    #[cfg(target_arch = "x86_64")]
    Avx512(V4),
}

/// The instructions of this run. Those that the environment names and this processor lacks are replaced by those of every processor;
/// [`check_instructions`] refuses them before a run.
#[inline(always)]
pub fn instructions() -> Instructions {
    match choice() {
        Ok(instructions) => *instructions,
        Err(_) => Instructions::Fallback,
    }
}

/// The proof of AVX2 where kernels are run with it.
#[cfg(target_arch = "x86_64")]
pub fn avx2() -> Option<V3> {
    match instructions() {
        Instructions::Fallback => None,
        Instructions::Avx2(simd) => Some(simd),
        Instructions::Avx512(simd) => Some(*simd),
    }
}

/// Returns the end of a sentence about a pipeline, which names the variable, its value and the remedy, if the environment asks for
/// instructions that this processor lacks.
pub fn check_instructions() -> Result<(), String> {
    choice().as_ref().map(|_| ()).map_err(Clone::clone)
}

#[inline(always)]
fn choice() -> &'static Result<Instructions, String> {
    static CHOICE: OnceLock<Result<Instructions, String>> = OnceLock::new();
    match CHOICE.get() {
        Some(choice) => choice,
        None => CHOICE.get_or_init(|| choose(std::env::var(VARIABLE).ok().as_deref())),
    }
}

/// The instructions of this name, the widest if it is empty or missing. Returns the end of a sentence, as [`check_instructions`] does, if
/// this processor lacks them.
#[cold]
#[inline(never)]
pub fn choose(wanted: Option<&str>) -> Result<Instructions, String> {
    let available = available();
    let Some(wanted) = wanted.filter(|wanted| !wanted.is_empty()) else { return Ok(available[available.len() - 1].1) };
    match available.iter().find(|(name, _)| *name == wanted) {
        Some((_, instructions)) => Ok(*instructions),
        None => {
            let names: Vec<_> = available.iter().map(|(name, _)| *name).collect();
            let names = names.join(", ");
            Err(format!(
                "is run with {VARIABLE} = \"{wanted}\", and this processor has {names}: set one of these, or unset it"
            ))
        }
    }
}

/// The instructions that this processor has, the widest last.
fn available() -> Vec<(&'static str, Instructions)> {
    let all = [
        ("fallback", Some(Instructions::Fallback)),
        #[cfg(target_arch = "x86_64")]
        ("avx2", V3::try_new().map(Instructions::Avx2)),
        #[cfg(target_arch = "x86_64")]
        ("avx512", V4::try_new().map(Instructions::Avx512)),
    ];
    all.into_iter().filter_map(|(name, instructions)| Some((name, instructions?))).collect()
}
