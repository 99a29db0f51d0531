//! For tests only: `cargo test` calls the C++ wrapper, `msdd.hpp`, through cxx. Nothing here is shipped: users call `msdd.h`,
//! where panics are caught, whereas a panic under cxx ends the process.
#![allow(unsafe_code)] // the bridge; what is behind it is C++

// The wrapper calls functions of the library: link it.
use msdd as _;

/// The C++ side, `bridge.hpp`.
#[cxx::bridge(namespace = "bridge")]
pub mod ffi {
    /// Columns (one value per cell); those of the state one after the other in one vector.
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

        /// An `msdd::Model`.
        type Model;
        fn load(source: &str) -> Result<UniquePtr<Model>>;
        fn state_size(self: &Model) -> usize;
        fn hash(self: &Model) -> String;
        /// Initial state columns of cells, one after the other.
        fn initial_state(self: &Model, porosity: &[f64], fabric_index: &[f64]) -> Result<Vec<f64>>;
        /// One step of grains of k = E = r = 1; the results replace the inputs.
        fn advance(self: &Model, cells: &mut Cells) -> Result<()>;
        /// Calls the C function itself, with a wrong struct_size.
        fn advance_with_wrong_size(self: &Model, cells: &mut Cells) -> Result<()>;
        /// Wall friction for grains of this mean radius [m]: limit [-], and the slip [m] at which half of the limit is
        /// mobilised; empty when the model does not know them.
        fn wall_friction(self: &Model, mean_radius: f64) -> Result<Vec<f64>>;
        /// Moves the wrapper in `model` to a new object.
        fn moved(model: Pin<&mut Model>) -> UniquePtr<Model>;
        /// Moves the wrapper into itself.
        fn move_into_itself(model: Pin<&mut Model>);

        /// Packs a small RVE, copies it by its text, strains both and returns their pressures.
        fn strained_rves(strain: f64) -> Result<Vec<f64>>;

        /// Traps division by zero, invalid and overflow on this thread, and clears the flags.
        fn trap();
        /// Whether all three are trapped on this thread and no flag is set.
        fn trapped_and_clear() -> bool;
    }
}

// SAFETY: the header allows any number of threads to use a model at a time, and the wrapper adds no state.
unsafe impl Sync for ffi::Model {}
// SAFETY: as above; freeing on another thread is a plain call.
unsafe impl Send for ffi::Model {}
