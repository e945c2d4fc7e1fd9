# The library itself: cargo decides at every build what there is to do, in a target folder of its own.
find_program(STRIAE_CARGO cargo HINTS "$ENV{CARGO_HOME}/bin" "$ENV{HOME}/.cargo/bin" DOC "Rust's package manager")
if(NOT STRIAE_CARGO)
  message(FATAL_ERROR "striae needs cargo: install Rust, https://rustup.rs, or set STRIAE_CARGO")
endif()
set(STRIAE_CARGO_TARGET_DIR "${PROJECT_BINARY_DIR}/cargo" CACHE PATH "Where cargo builds the library")

# Until 1.0 a minor version may change the binary interface, so the SONAME carries it.
set(striae_soname "libstriae.so.${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}")
set(striae_lib_dir "${PROJECT_BINARY_DIR}/lib")
set(striae_shared_library "${striae_lib_dir}/libstriae.so.${PROJECT_VERSION}")
set(striae_static_library "${striae_lib_dir}/libstriae.a")

set(striae_cargo_features "")
if(NOT STRIAE_FILES)
  set(striae_cargo_features --no-default-features)
endif()

# `cargo rustc` is `cargo build` with arguments for this crate's own link step, here the SONAME.
# Cargo's files are copied under their versioned names only when they changed, so nothing relinks in vain.
add_custom_target(striae_cargo ALL
  COMMAND "${CMAKE_COMMAND}" -E env --unset=CARGO_BUILD_TARGET
          "${STRIAE_CARGO}" rustc --lib --release --locked ${striae_cargo_features}
          --manifest-path "${PROJECT_SOURCE_DIR}/Cargo.toml" --target-dir "${STRIAE_CARGO_TARGET_DIR}"
          -- -C "link-arg=-Wl,-soname,${striae_soname}"
  COMMAND "${CMAKE_COMMAND}" -E make_directory "${striae_lib_dir}"
  COMMAND "${CMAKE_COMMAND}" -E copy_if_different "${STRIAE_CARGO_TARGET_DIR}/release/libstriae.so" "${striae_shared_library}"
  COMMAND "${CMAKE_COMMAND}" -E copy_if_different "${STRIAE_CARGO_TARGET_DIR}/release/libstriae.a" "${striae_static_library}"
  COMMAND "${CMAKE_COMMAND}" -E create_symlink "libstriae.so.${PROJECT_VERSION}" "${striae_lib_dir}/${striae_soname}"
  COMMAND "${CMAKE_COMMAND}" -E create_symlink "${striae_soname}" "${striae_lib_dir}/libstriae.so"
  BYPRODUCTS "${striae_shared_library}" "${striae_static_library}"
             "${striae_lib_dir}/${striae_soname}" "${striae_lib_dir}/libstriae.so"
  USES_TERMINAL
  VERBATIM)

add_library(striae::striae SHARED IMPORTED GLOBAL)
set_target_properties(striae::striae PROPERTIES
  IMPORTED_LOCATION "${striae_shared_library}"
  IMPORTED_SONAME "${striae_soname}"
  INTERFACE_INCLUDE_DIRECTORIES "${PROJECT_SOURCE_DIR}/include")
add_dependencies(striae::striae striae_cargo)

# What Rust's standard library calls on Linux.
set(striae_system_libraries gcc_s util rt pthread m dl c)
add_library(striae::striae_static STATIC IMPORTED GLOBAL)
set_target_properties(striae::striae_static PROPERTIES
  IMPORTED_LOCATION "${striae_static_library}"
  INTERFACE_LINK_LIBRARIES "${striae_system_libraries}"
  INTERFACE_INCLUDE_DIRECTORIES "${PROJECT_SOURCE_DIR}/include")
add_dependencies(striae::striae_static striae_cargo)
