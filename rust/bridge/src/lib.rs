//! Test only: `cargo test` drives the real C++ wrapper, `msdd.hpp`, through cxx. Nothing here is shipped: a panic under cxx
//! ends the process, so the production boundary is `msdd.h`.
#![allow(unsafe_code)] // the bridge; what is behind it is C++

// The wrapper calls the library's exports: link them.
use msdd as _;

/// The C++ side, `bridge.hpp`.
#[cxx::bridge(namespace = "bridge")]
pub mod ffi {
    /// Columns of cells; those of state one after another.
    #[derive(Clone, Debug, Default, PartialEq)]
    struct Cells {
        state: Vec<f64>,
        thermal_strain: Vec<f64>,
        conductivity_xx: Vec<f64>,
        conductivity_yy: Vec<f64>,
        stress_xx: Vec<f64>,
        stress_yy: Vec<f64>,
        clamped_cells: usize,
    }

    unsafe extern "C++" {
        include!("msdd-bridge/src/bridge.hpp");

        /// An `msdd::Surrogate`.
        type Model;
        fn load(source: &str) -> Result<UniquePtr<Model>>;
        fn state_size(self: &Model) -> usize;
        fn hash(self: &Model) -> String;
        /// State columns of cells, one after another.
        fn initial_state(self: &Model, porosity: &[f64], fabric_index: &[f64]) -> Result<Vec<f64>>;
        /// One step of grains of k = E = r = 1, in place.
        fn advance(self: &Model, cells: &mut Cells) -> Result<()>;
        /// The same through the C function itself, with a wrong struct_size.
        fn advance_with_wrong_size(self: &Model, cells: &mut Cells) -> Result<()>;
        /// Limit [-] and slip [m] of half of it, of walls that grains of this mean radius [m] rub; empty when the model
        /// has none.
        fn wall_friction(self: &Model, mean_radius: f64) -> Result<Vec<f64>>;
        /// Moves the wrapper out of `model` into another.
        fn moved(model: Pin<&mut Model>) -> UniquePtr<Model>;
        /// Moves the wrapper into itself.
        fn move_into_itself(model: Pin<&mut Model>);

        /// Packs a small RVE, copies it by its text, strains both and returns their pressures.
        fn strained_rves(strain: f64) -> Result<Vec<f64>>;

        /// Traps division by zero, invalid and overflow on this thread, and clears the flags.
        fn trap();
        /// Whether all three are trapped on this thread and no flag is up.
        fn trapped_and_clear() -> bool;
    }
}

// SAFETY: the header allows any number of threads to use a surrogate at a time, and the wrapper adds no state.
unsafe impl Sync for ffi::Model {}
// SAFETY: as above; freeing on another thread is a plain call.
unsafe impl Send for ffi::Model {}
