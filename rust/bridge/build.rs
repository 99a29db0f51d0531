//! Compiles the bridge and its C++ side against msdd.hpp, with warnings as errors in our own files.

fn main() {
    cxx_build::bridge("src/lib.rs")
        .file("src/bridge.cpp")
        .include("../capi/include")
        .include("../../openfoam")
        .flag("-frounding-math")
        .std("c++11")
        .compile("msdd-bridge");
    for file in [
        "src/bridge.cpp",
        "src/bridge.hpp",
        "../capi/include/msdd.h",
        "../capi/include/msdd_v4.h",
        "../../openfoam/msdd.hpp",
    ] {
        println!("cargo:rerun-if-changed={file}");
    }
}
