//! Loads a shared library and gets its checked table of functions.

use crate::PluginError;
use libloading::os::unix::{Library, RTLD_LOCAL, RTLD_NOW};
use msdd_abi::{MSDD_PLUGIN_VERSION, msdd_plugin_v2};
use sha2::{Digest, Sha256};
use std::ffi::{CStr, c_char};
use std::path::Path;

/// The function that every plug-in defines; it returns the table.
const SYMBOL: &CStr = c"msdd_plugin_v2_table";
/// The function of version 1.
const OLD_SYMBOL: &CStr = c"msdd_plugin_v1_table";

/// `e_machine` of ELF files for this processor (ELF specification, and its supplements).
const MACHINE: Option<(u16, &str)> = match () {
    () if cfg!(target_arch = "x86_64") => Some((62, "x86-64")),
    () if cfg!(target_arch = "aarch64") => Some((183, "AArch64")),
    () => None,
};

/// The table of a plug-in, whose version and size have been checked, but not yet its pointers.
pub(crate) struct Loaded {
    pub table: msdd_plugin_v2,
    /// SHA-256 of the file, hexadecimal.
    pub hash: String,
}

/// Loads a library, which is never unloaded, and gets its table.
///
/// # Errors
/// [`PluginError::Read`] or [`PluginError::Unfit`].
pub(crate) fn load(path: &Path) -> Result<Loaded, PluginError> {
    let shown = path.display().to_string();
    let unfit = |reason: String| PluginError::Unfit { path: shown.clone(), reason };
    let read = |error| PluginError::Read { path: shown.clone(), error };
    // An absolute path, because the loader would look for a bare name in the system's folders.
    let absolute = path.canonicalize().map_err(read)?;
    let bytes = std::fs::read(&absolute).map_err(read)?;
    check_file(&bytes).map_err(unfit)?;
    // SAFETY: the library's initialisers run; the caller trusts the code of the plug-in that it names.
    let library = unsafe { Library::open(Some(&absolute), RTLD_NOW | RTLD_LOCAL) };
    let library = library.map_err(|error| unfit(format!("the system's loader refuses it: {error}")))?;
    // SAFETY: the header gives this symbol this type.
    let symbol = unsafe {
        library.get::<unsafe extern "C" fn() -> *const msdd_plugin_v2>(SYMBOL.to_bytes_with_nul()).map(|f| *f)
    };
    let Ok(entry) = symbol else {
        // SAFETY: the symbol is looked for and not called.
        let old = unsafe { library.get::<unsafe extern "C" fn()>(OLD_SYMBOL.to_bytes_with_nul()).is_ok() };
        let reason = if old {
            "has version 1 of the plug-in interface, which has no shear; this library has version 2: build it against this \
             library's msdd.h"
        } else {
            "has no function msdd_plugin_v2_table, see msdd.h"
        };
        return Err(unfit(reason.to_string()));
    };
    // Never unloaded, so that its texts and functions stay valid, also for threads that it may have started.
    std::mem::forget(library);
    // SAFETY: takes nothing; its type is the header's.
    let table = unsafe { entry() };
    // SAFETY: null, or as long as its first field says, by the header.
    let table = unsafe { checked(table) }.map_err(unfit)?;
    Ok(Loaded { table, hash: Sha256::digest(&bytes).iter().map(|byte| format!("{byte:02x}")).collect() })
}

/// Refuses what is not a shared library for this machine. The system's loader would refuse it, too, but its message for a
/// library of another machine may be "No such file".
fn check_file(bytes: &[u8]) -> Result<(), String> {
    if !cfg!(target_os = "linux") {
        return Ok(());
    }
    if bytes.len() < 20 || bytes[..4] != *b"\x7fELF" {
        return Err("is no shared library (no ELF file)".to_string());
    }
    let bits = if bytes[4] == 2 { 64 } else { 32 };
    let found = u16::from_le_bytes([bytes[18], bytes[19]]);
    match MACHINE {
        Some((machine, name)) if (bits, bytes[5], found) != (64, 1, machine) => Err(format!(
            "is built for another machine (ELF machine {found}, {bits} bits), this program for {name} \
             (machine {machine}, 64 bits)"
        )),
        _ => Ok(()),
    }
}

/// A copy of the table, once version and size are right.
///
/// # Safety
/// `table` is null or points to a struct that starts with a size and a version and is as long as the size says.
unsafe fn checked(table: *const msdd_plugin_v2) -> Result<msdd_plugin_v2, String> {
    if table.is_null() {
        return Err("msdd_plugin_v2_table returned NULL".to_string());
    }
    // SAFETY: not null; size and version come first in every version, by this function's contract.
    let (size, version) =
        unsafe { ((&raw const (*table).struct_size).read(), (&raw const (*table).version).read()) };
    if version != MSDD_PLUGIN_VERSION {
        return Err(format!(
            "has version {version} of the plug-in table, this library has {MSDD_PLUGIN_VERSION}"
        ));
    }
    let expected = size_of::<msdd_plugin_v2>();
    if size != expected {
        return Err(format!(
            "struct_size of its table is {size}, allowed: {expected}; build it against this library's msdd.h"
        ));
    }
    // SAFETY: of full size, by this function's contract.
    Ok(unsafe { table.read() })
}

/// Copies a text of the plug-in.
///
/// # Safety
/// `text` is null or a C string.
pub(crate) unsafe fn text(name: &str, text: *const c_char) -> Result<String, String> {
    if text.is_null() {
        return Err(format!("{name} is NULL"));
    }
    // SAFETY: not null, a C string by this function's contract.
    let text = unsafe { CStr::from_ptr(text) };
    match text.to_str() {
        Ok("") => Err(format!("{name} is empty")),
        Ok(text) => Ok(text.to_string()),
        Err(_) => Err(format!("{name} = {:?} is not UTF-8", text.to_string_lossy())),
    }
}
