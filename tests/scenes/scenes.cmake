# Every scene under configs/ that has a [test] table is a test, once for each number of ranks it names. The first number
# writes the history that the others must repeat.
file(GLOB_RECURSE scenes CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/configs/*.toml)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${scenes})
set(run_scene ${CMAKE_CURRENT_SOURCE_DIR}/scenes/run_scene.py)
execute_process(COMMAND ${Python3_EXECUTABLE} ${run_scene} --list ${PROJECT_SOURCE_DIR}/configs
                OUTPUT_VARIABLE listed OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE "\n" ";" listed "${listed}")
foreach(line IN LISTS listed)  # "muscle/block.toml 1 2"
  string(REPLACE " " ";" words "${line}")
  list(POP_FRONT words scene)
  list(GET words 0 first)
  string(REGEX REPLACE "\\.toml$" "" name ${scene})
  foreach(ranks IN LISTS words)
    set(test scene_${name}_np${ranks})
    add_test(NAME ${test} COMMAND Python3::Interpreter ${run_scene} ${PROJECT_SOURCE_DIR}/configs/${scene} --ranks ${ranks}
             --titin $<TARGET_FILE:titin> --mpirun ${MPIEXEC_EXECUTABLE} --scratch ${CMAKE_CURRENT_BINARY_DIR}/scenes/${name})
    titin_ctest_properties(${test} scenes ${ranks} 900)
    if(ranks EQUAL first)
      set_tests_properties(${test} PROPERTIES FIXTURES_SETUP ${name}_first)
    else()
      set_tests_properties(${test} PROPERTIES FIXTURES_REQUIRED ${name}_first)
    endif()
  endforeach()
endforeach()
