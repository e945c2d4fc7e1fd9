# Installs the headers, both libraries, the CMake package and the pkg-config file. Everything finds its
# way from where it lies, so that an installed tree may be moved.
include(CMakePackageConfigHelpers)
set(striae_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/striae")

install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
        FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp")
install(FILES "${striae_shared_library}" "${striae_lib_dir}/${striae_soname}" "${striae_lib_dir}/libstriae.so"
              "${striae_static_library}"
        DESTINATION "${CMAKE_INSTALL_LIBDIR}")

configure_package_config_file(cmake/striae-config.cmake.in "${PROJECT_BINARY_DIR}/striae-config.cmake"
  INSTALL_DESTINATION "${striae_package_dir}"
  PATH_VARS CMAKE_INSTALL_INCLUDEDIR CMAKE_INSTALL_LIBDIR)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/striae-config-version.cmake"
  VERSION "${PROJECT_VERSION}" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/striae-config.cmake" "${PROJECT_BINARY_DIR}/striae-config-version.cmake"
        DESTINATION "${striae_package_dir}")

file(RELATIVE_PATH striae_pc_to_prefix
  "/prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/prefix")
list(TRANSFORM striae_system_libraries PREPEND "-l" OUTPUT_VARIABLE striae_private_libraries)
list(JOIN striae_private_libraries " " striae_private_libraries)
configure_file(cmake/striae.pc.in "${PROJECT_BINARY_DIR}/striae.pc" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/striae.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
