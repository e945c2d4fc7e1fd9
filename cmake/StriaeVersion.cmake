# STRIAE_VERSION, from the one place that states it: the [package] table of Cargo.toml.
set(striae_manifest "${CMAKE_CURRENT_LIST_DIR}/../Cargo.toml")
file(STRINGS "${striae_manifest}" striae_version_lines REGEX "^version *= *\"")
if(NOT striae_version_lines MATCHES "^version *= *\"([0-9]+\\.[0-9]+\\.[0-9]+)")
  message(FATAL_ERROR "${striae_manifest} states no version = \"major.minor.patch\"")
endif()
set(STRIAE_VERSION "${CMAKE_MATCH_1}")
