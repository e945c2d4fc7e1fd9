# The paper's Figure 9, small: the sheet and the parts of all sixteen cells come out; wrong arguments are named.
set(figure9 "${CMAKE_CURRENT_BINARY_DIR}/figure9")

add_test(NAME figure9 COMMAND "${CMAKE_COMMAND}" "-DCOMMAND=$<TARGET_FILE:striae_figure9>"
  "-DARGUMENTS='${figure9}' 128" -DEXIT_CODE=0 "-DOUTPUT=picture: .*figure-9.png"
  -P "${CMAKE_CURRENT_SOURCE_DIR}/expect.cmake")
add_test(NAME figure9_bad_width COMMAND "${CMAKE_COMMAND}" "-DCOMMAND=$<TARGET_FILE:striae_figure9>"
  "-DARGUMENTS='${figure9}' 12x" -DEXIT_CODE=2 "-DOUTPUT=WIDTH from 128 to 1024"
  -P "${CMAKE_CURRENT_SOURCE_DIR}/expect.cmake")
add_test(NAME figure9_bad_folder COMMAND "${CMAKE_COMMAND}" "-DCOMMAND=$<TARGET_FILE:striae_figure9>"
  "-DARGUMENTS=/proc/nowhere" -DEXIT_CODE=1 "-DOUTPUT=/proc/nowhere: "
  -P "${CMAKE_CURRENT_SOURCE_DIR}/expect.cmake")

set(pictures figure-9.png)
foreach(group tool hardness force orientation)
  foreach(cell 1 2 3 4)
    list(APPEND pictures figure-9/${group}-${cell}.exr figure-9/${group}-${cell}.png figure-9/${group}-${cell}.svg)
  endforeach()
endforeach()
string(REPLACE ";" " " pictures "${pictures}")
add_test(NAME figure9_pictures COMMAND "${CMAKE_COMMAND}" "-DFOLDER=${figure9}" "-DPICTURES=${pictures}"
  -P "${CMAKE_CURRENT_SOURCE_DIR}/figure9_pictures.cmake")
foreach(name figure9 figure9_bad_width figure9_bad_folder figure9_pictures)
  striae_test_settings(${name})
endforeach()
set_tests_properties(figure9 PROPERTIES FIXTURES_SETUP figure9)
set_tests_properties(figure9_pictures PROPERTIES FIXTURES_REQUIRED figure9)
