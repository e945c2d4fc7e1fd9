# The example renderer as a program: pictures come out, the check holds, wrong options are named.
set(pictures "${CMAKE_CURRENT_BINARY_DIR}/pictures")

# renderer_test(NAME EXIT_CODE OUTPUT ARGUMENT...): OUTPUT is a regular expression.
function(renderer_test name exit_code output)
  string(REPLACE ";" " " arguments "${ARGN}")
  add_test(NAME renderer_${name} COMMAND "${CMAKE_COMMAND}" "-DCOMMAND=$<TARGET_FILE:striae_render>"
    "-DARGUMENTS=${arguments}" "-DEXIT_CODE=${exit_code}" "-DOUTPUT=${output}"
    -P "${CMAKE_CURRENT_SOURCE_DIR}/expect.cmake")
  striae_test_settings(renderer_${name})
endfunction()

renderer_test(check 0 "worst view: RMS [0-9.]+ %" --check --aov --width 128 --height 72 --out "'${pictures}'")
renderer_test(many_samples 0 "contact-sheet.png" --spp 16 --width 96 --height 54 --threads 1 --out "'${pictures}-16'")
renderer_test(help 0 "--width N" --help)
renderer_test(bad_width 2 "--width is \"12x\"; accepted: a whole number from 16 to 8192" --width 12x)
renderer_test(bad_height 2 "--height is \"-1\"; accepted: a whole number from 16 to 8192" --height -1)
renderer_test(bad_spp 2 "--spp is \"7\"; accepted: a square number from 1 to 1024" --spp 7)
renderer_test(bad_threads 2 "--threads is \"0\"; accepted: a whole number from 1 to 256" --threads 0)
renderer_test(bad_scene 1 "--scene is \"spoon\"; accepted: plate, crossing, aluminium, car, ring" --scene spoon --out "'${pictures}'")
renderer_test(no_value 2 "--out needs a value" --out)
renderer_test(unknown_option 2 "\"--spoons\" is not an option" --spoons 3)
renderer_test(bad_folder 1 "/proc/nowhere: " --out /proc/nowhere)

renderer_test(bad_integrator 2 "--integrator is \"rays\"; accepted: direct, paths" --integrator rays)
renderer_test(bad_frames 2 "--frames goes to 4; accepted: up to 3" --frames 2-4 --out "'${pictures}'")
renderer_test(bad_tiles 2 "--tiles is \"7-3\"; accepted: two whole numbers from 0 to 65535, as in 3-7" --tiles 7-3)
renderer_test(too_many_tiles 2 "--tiles goes to 99; accepted: up to 11" --integrator paths --tiles 0-99 --width 100 --height 70
  --out "'${pictures}'")
renderer_test(direct_tiles 2 "accepted with --integrator paths only" --tiles 0-1 --out "'${pictures}'")
renderer_test(direct_reflections 2 "accepted with --integrator paths only" --reflections 2 --out "'${pictures}'")
renderer_test(bad_environment 1 "/proc/nowhere.exr: " --integrator paths --environment /proc/nowhere.exr --out "'${pictures}'")

# Every figure's scene can be built, and a small picture of it comes out.
foreach(scene crossing aluminium car ring)
  renderer_test(scene_${scene} 0 "figure-[0-9]+.*[.]png" --scene ${scene} --spp 1 --width 48 --height 27 --out "'${pictures}-scenes'")
endforeach()

# What paths find, and that a split picture is the whole one.
striae_c_test(paths paths.c LIBRARIES striae_renderer striae::striae)
add_test(NAME renderer_split COMMAND "${CMAKE_COMMAND}" "-DCOMMAND=$<TARGET_FILE:striae_render>"
  "-DFOLDER=${CMAKE_CURRENT_BINARY_DIR}/split" -P "${CMAKE_CURRENT_SOURCE_DIR}/split.cmake")
striae_test_settings(renderer_split)

# What judges the library takes minutes: here it only refuses what it should.
add_test(NAME compare_bad_samples COMMAND "${CMAKE_COMMAND}" "-DCOMMAND=$<TARGET_FILE:striae_compare>"
  "-DARGUMENTS=nowhere 1" -DEXIT_CODE=2 "-DOUTPUT=SAMPLES is \"1\"; accepted: a whole number from 2 to 1000000"
  -P "${CMAKE_CURRENT_SOURCE_DIR}/expect.cmake")
striae_test_settings(compare_bad_samples)

add_test(NAME renderer_pictures COMMAND "${CMAKE_COMMAND}" "-DFOLDER=${pictures}"
  -P "${CMAKE_CURRENT_SOURCE_DIR}/pictures.cmake")
striae_c_test(renderer_layers renderer_layers.c LIBRARIES striae_renderer striae::striae)
target_include_directories(test_renderer_layers SYSTEM PRIVATE "${OPENEXR_INCLUDE_DIR}")
set_tests_properties(renderer_layers PROPERTIES ENVIRONMENT "PICTURES=${pictures}" FIXTURES_REQUIRED pictures)
set_tests_properties(renderer_check PROPERTIES FIXTURES_SETUP pictures)
set_tests_properties(renderer_pictures PROPERTIES FIXTURES_REQUIRED pictures)
