# A picture by paths, rendered at once, in parts joined by --resume, and finished after a stop, is the same byte for byte.
message("protects: split and resumed pictures are the whole ones, with any number of threads")
set(common --integrator paths --spp 2 --width 100 --height 70)

function(render folder)
  execute_process(COMMAND "${COMMAND}" ${common} --out "${FOLDER}/${folder}" ${ARGN} RESULT_VARIABLE code
    OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ARGN}: exit code ${code}\n${text}")
  endif()
endfunction()

function(expect_same folder name)
  file(SHA256 "${FOLDER}/whole/${name}" whole)
  file(SHA256 "${FOLDER}/${folder}/${name}" part)
  if(NOT whole STREQUAL part)
    message(FATAL_ERROR "${folder}/${name} is not the whole picture")
  endif()
endfunction()

file(REMOVE_RECURSE "${FOLDER}")
file(MAKE_DIRECTORY "${FOLDER}")
render(whole --frames 1-2 --threads 1)

# Twelve tiles on "two machines", which need not be done in order; one is not done at all, and left to the joining job.
render(parts --frames 2 --tiles 6-11 --threads 2)
render(parts --frames 2 --tiles 0-4 --threads 1)
render(parts --frames 2 --resume)
expect_same(parts plate-2.exr)
expect_same(parts plate-2.png)

# A job that was stopped: its file has some tiles only.
render(stopped --frames 1 --tiles 3-7)
file(RENAME "${FOLDER}/stopped/plate-1.tiles-3-7.exr" "${FOLDER}/stopped/plate-1.exr")
render(stopped --frames 1 --resume)
expect_same(stopped plate-1.exr)

# Parts of another picture are refused.
execute_process(COMMAND "${COMMAND}" ${common} --spp 3 --out "${FOLDER}/whole" --frames 1 --resume RESULT_VARIABLE code
  ERROR_VARIABLE text)
if(NOT code EQUAL 1 OR NOT text MATCHES "plate-1.exr: has another number of samples per pixel than --spp")
  message(FATAL_ERROR "exit code ${code}\n${text}")
endif()
