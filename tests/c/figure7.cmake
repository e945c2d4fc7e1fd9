# The paper's Figure 7, small: the sheet and its eight parts come out; wrong arguments are named.
set(figure7 "${CMAKE_CURRENT_BINARY_DIR}/figure7")

add_test(NAME figure7 COMMAND "${CMAKE_COMMAND}" "-DCOMMAND=$<TARGET_FILE:striae_figure7>"
  "-DARGUMENTS='${figure7}' 64" -DEXIT_CODE=0 "-DOUTPUT=picture: .*figure-7.png"
  -P "${CMAKE_CURRENT_SOURCE_DIR}/expect.cmake")
add_test(NAME figure7_bad_width COMMAND "${CMAKE_COMMAND}" "-DCOMMAND=$<TARGET_FILE:striae_figure7>"
  "-DARGUMENTS='${figure7}' 12x" -DEXIT_CODE=2 "-DOUTPUT=WIDTH of each picture from 64 to 2000"
  -P "${CMAKE_CURRENT_SOURCE_DIR}/expect.cmake")
add_test(NAME figure7_bad_folder COMMAND "${CMAKE_COMMAND}" "-DCOMMAND=$<TARGET_FILE:striae_figure7>"
  "-DARGUMENTS=/proc/nowhere" -DEXIT_CODE=1 "-DOUTPUT=/proc/nowhere: "
  -P "${CMAKE_CURRENT_SOURCE_DIR}/expect.cmake")

set(pictures figure-7.png)
foreach(system curves mdg01 bl99 bb90)
  list(APPEND pictures figure-7/${system}-far.exr figure-7/${system}-near.exr)
endforeach()
string(REPLACE ";" " " pictures "${pictures}")
add_test(NAME figure7_pictures COMMAND "${CMAKE_COMMAND}" "-DFOLDER=${figure7}" "-DPICTURES=${pictures}"
  -P "${CMAKE_CURRENT_SOURCE_DIR}/figure9_pictures.cmake")
foreach(name figure7 figure7_bad_width figure7_bad_folder figure7_pictures)
  striae_test_settings(${name})
endforeach()
set_tests_properties(figure7 PROPERTIES FIXTURES_SETUP figure7)
set_tests_properties(figure7_pictures PROPERTIES FIXTURES_REQUIRED figure7)
