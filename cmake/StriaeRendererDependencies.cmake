# What the example renderer draws on: Embree 3 or 4 (rays), OpenEXR's C core (linear pictures), libpng.
# They are looked for as plain C headers and libraries, since OpenEXR's own package needs a C++ compiler.
find_package(PNG)
find_package(Threads REQUIRED)
find_path(EMBREE_INCLUDE_DIR rtcore.h PATH_SUFFIXES embree4 embree3 DOC "Folder of Embree's rtcore.h")
find_library(EMBREE_LIBRARY NAMES embree4 embree3 DOC "Embree 4 or 3")
find_path(OPENEXR_INCLUDE_DIR openexr.h PATH_SUFFIXES OpenEXR DOC "Folder of openexr.h, the C core")
find_library(OPENEXR_CORE_LIBRARY NAMES OpenEXRCore OpenEXRCore-3_1 DOC "OpenEXR's C core")

set(striae_renderer_missing "")
foreach(part EMBREE_INCLUDE_DIR EMBREE_LIBRARY OPENEXR_INCLUDE_DIR OPENEXR_CORE_LIBRARY PNG_FOUND)
  if(NOT ${part})
    list(APPEND striae_renderer_missing ${part})
  endif()
endforeach()
