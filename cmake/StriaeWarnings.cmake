# striae_warnings(TARGET): the warnings under which the examples and tests are kept clean.
function(striae_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -pedantic)
  if(STRIAE_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()
