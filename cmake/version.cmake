# base/version.hpp: what run.json says of the program. The commit is read at configure time.
execute_process(COMMAND git describe --always --dirty WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
                OUTPUT_VARIABLE TITIN_COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT TITIN_COMMIT)
  set(TITIN_COMMIT "unknown")
endif()
set_source_files_properties(src/base/version.cpp PROPERTIES COMPILE_DEFINITIONS
  "TITIN_VERSION=\"${PROJECT_VERSION}\";TITIN_COMMIT=\"${TITIN_COMMIT}\"")
