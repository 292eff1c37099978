# The functions that register tests with CTest.

# Tests run side by side, so that each keeps to one thread.
set(kedge_test_environment OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1
  PYTHONDONTWRITEBYTECODE=1)
if(KEDGE_SANITIZE)
  list(APPEND kedge_test_environment ASAN_OPTIONS=detect_leaks=1
    LSAN_OPTIONS=suppressions=${CMAKE_CURRENT_LIST_DIR}/sanitize/leaks.txt:print_suppressions=0
    UBSAN_OPTIONS=print_stacktrace=1)
endif()
find_program(KEDGE_MPIRUN NAMES mpirun mpiexec REQUIRED)

# kedge_add_test(name COMMAND ... [LABELS ...] [RANKS n] [TIMEOUT s])
# The limits guard against tests that hang. They are those of a quiet machine times
# KEDGE_TEST_PATIENCE, for a slow or loaded machine is no fault.
set(KEDGE_TEST_PATIENCE 6 CACHE STRING "Factor on the time limits of tests")
function(kedge_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "RANKS;TIMEOUT" "COMMAND;LABELS")
  foreach(default "RANKS=1" "TIMEOUT=120")
    string(REGEX MATCH "([A-Z]+)=(.*)" unused ${default})
    if(NOT arg_${CMAKE_MATCH_1})
      set(arg_${CMAKE_MATCH_1} ${CMAKE_MATCH_2})
    endif()
  endforeach()
  math(EXPR limit "${arg_TIMEOUT} * ${KEDGE_TEST_PATIENCE}")
  add_test(NAME ${name} COMMAND ${arg_COMMAND})
  set_tests_properties(${name} PROPERTIES
    ENVIRONMENT "${kedge_test_environment}" PROCESSORS ${arg_RANKS}
    TIMEOUT ${limit} LABELS "${arg_LABELS}"
    FAIL_REGULAR_EXPRESSION "Running 0 tests")
endfunction()

# kedge_add_unit_tests(target SOURCES ... [PREFIX p] [DEBUG library sources ...])
# One executable of all sources; one CTest test for each GoogleTest suite in
# them, because starting a process costs more than most suites. A suite whose
# name ends in Mpi runs on one rank and, as NAME.2ranks, on two. With DEBUG
# the tests do not use the library but what stands there, compiled without
# optimisation and with all assertions.
function(kedge_add_unit_tests target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "PREFIX" "SOURCES;DEBUG")
  add_executable(${target} ${arg_SOURCES})
  if(arg_DEBUG)
    target_sources(${target} PRIVATE ${arg_DEBUG} ${PROJECT_BINARY_DIR}/source/base/revision.cc)
    target_include_directories(${target} PRIVATE
      ${PROJECT_SOURCE_DIR}/include ${PROJECT_BINARY_DIR}/include)
    add_dependencies(${target} kedge_revision)
    deal_ii_setup_target(${target} DEBUG)
    target_compile_options(${target} PRIVATE -Wall -Wextra -Werror)
  else()
    target_link_libraries(${target} kedge::kedge)
    kedge_set_up_target(${target})
    target_compile_options(${target} PRIVATE -O1) # they are run once, and short
    target_precompile_headers(${target} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/pch.h)
    kedge_skip_precompiled_header(${CMAKE_CURRENT_SOURCE_DIR})
  endif()
  target_link_libraries(${target} GTest::gtest)

  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${arg_SOURCES})
  kedge_find_suites(suites ${arg_SOURCES})
  foreach(suite IN LISTS suites)
    set(run $<TARGET_FILE:${target}> "--gtest_filter=${suite}.*:${suite}/*:*/${suite}.*:*/${suite}/*")
    kedge_add_test(${arg_PREFIX}${suite} LABELS unit COMMAND ${run})
    if(suite MATCHES "Mpi$")
      kedge_add_test(${arg_PREFIX}${suite}.2ranks LABELS unit mpi RANKS 2
        COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/mpirun.py
          ${KEDGE_MPIRUN} 2 ${run})
    endif()
  endforeach()
endfunction()

# The names of the suites in the given sources, by reading them.
function(kedge_find_suites result)
  set(suites)
  foreach(source IN LISTS ARGN)
    file(READ ${source} text)
    string(REGEX MATCHALL "\n(TYPED_)?TEST(_F|_P)?[ \n]*\\([ \n]*[A-Za-z0-9_]+" tests "\n${text}")
    foreach(test IN LISTS tests)
      string(REGEX REPLACE ".*\\([ \n]*" "" suite ${test})
      list(APPEND suites ${suite})
    endforeach()
  endforeach()
  list(REMOVE_DUPLICATES suites)
  set(${result} ${suites} PARENT_SCOPE)
endfunction()

# kedge_add_scene_test(name scene.prm
#   [RANKS n]              under mpirun; 1 by default
#   [SET "Section/Name = value" ...]   wins over the scene
#   [OPTIONS ...]          further options of kedge
#   [STDIN file]           with `-` as the scene: what it reads
#   [EXPECT_EXIT n]        0 by default
#   [EXPECT_STDERR regex]  Python, must be found in what it says on stderr
#   [EXPECT_STDOUT regex]  the same of stdout
#   [COMPARE_RANKS tol]    runs on 1 and 2 ranks; the histories must agree
#   [TIMEOUT s] [LABELS ...])
# The scene is given relative to the project's root and runs with --strict:
# a failed check of its own fails the test. A scene that is to finish must
# carry checks or give EXPECT_STDOUT, one that is to fail EXPECT_STDERR;
# else the test has no reference and CMake stops.
function(kedge_add_scene_test name scene)
  cmake_parse_arguments(PARSE_ARGV 2 arg ""
    "RANKS;STDIN;EXPECT_EXIT;EXPECT_STDERR;EXPECT_STDOUT;COMPARE_RANKS;TIMEOUT" "SET;OPTIONS;LABELS")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "scene test ${name}: what is ${arg_UNPARSED_ARGUMENTS}?")
  endif()
  if(NOT arg_EXPECT_EXIT)
    set(arg_EXPECT_EXIT 0)
  endif()
  if(NOT arg_RANKS)
    set(arg_RANKS 1)
  endif()
  kedge_demand_reference()

  set(command ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/run_scene.py
    --kedge $<TARGET_FILE:kedge> --mpirun ${KEDGE_MPIRUN} --root ${PROJECT_SOURCE_DIR}
    --output ${CMAKE_CURRENT_BINARY_DIR}/scenes/${name} --ranks ${arg_RANKS}
    --expect-exit ${arg_EXPECT_EXIT})
  kedge_append_options(command --set ${arg_SET})
  kedge_append_options(command --option ${arg_OPTIONS})
  foreach(key STDIN EXPECT_STDERR EXPECT_STDOUT COMPARE_RANKS)
    if(DEFINED arg_${key})
      string(TOLOWER "--${key}=" option)
      string(REPLACE "_" "-" option ${option})
      list(APPEND command "${option}${arg_${key}}")
    endif()
  endforeach()
  if(DEFINED arg_COMPARE_RANKS)
    set(arg_RANKS 2)
  endif()
  kedge_add_test(${name} COMMAND ${command} ${scene}
    LABELS scene ${arg_LABELS} RANKS ${arg_RANKS} TIMEOUT ${arg_TIMEOUT})
endfunction()

# Appends option=value to the list for each value; a value may hold semicolons.
function(kedge_append_options list option)
  foreach(number RANGE 2 ${ARGC})
    if(number LESS ARGC)
      string(REPLACE ";" "\\;" value "${ARGV${number}}")
      list(APPEND ${list} "${option}=${value}")
    endif()
  endforeach()
  set(${list} "${${list}}" PARENT_SCOPE)
endfunction()

# Of kedge_add_scene_test: stops CMake if the test could not fail.
macro(kedge_demand_reference)
  if(NOT arg_EXPECT_EXIT EQUAL 0 AND NOT DEFINED arg_EXPECT_STDERR)
    message(FATAL_ERROR "scene test ${name}: EXPECT_EXIT needs EXPECT_STDERR")
  endif()
  if(arg_EXPECT_EXIT EQUAL 0 AND NOT DEFINED arg_EXPECT_STDOUT AND NOT DEFINED arg_EXPECT_STDERR)
    if(NOT EXISTS ${PROJECT_SOURCE_DIR}/${scene})
      message(FATAL_ERROR "scene test ${name}: there is no ${scene}")
    endif()
    file(STRINGS ${PROJECT_SOURCE_DIR}/${scene} checks REGEX "^ *subsection +Checks")
    if(NOT checks)
      message(FATAL_ERROR "scene test ${name}: ${scene} has no Checks section, so there is nothing to test")
    endif()
  endif()
endmacro()

# kedge_add_restart_test(name scene.prm KILLS n [RANKS n] [SET ...] [TIMEOUT s])
# Kills the run n times at random moments, resumes it each time and demands
# the uninterrupted run's history bit for bit.
function(kedge_add_restart_test name scene)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "KILLS;RANKS;TIMEOUT" "SET")
  if(NOT arg_RANKS)
    set(arg_RANKS 1)
  endif()
  set(command ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/kill_and_resume.py
    --kedge $<TARGET_FILE:kedge> --mpirun ${KEDGE_MPIRUN} --root ${PROJECT_SOURCE_DIR}
    --output ${CMAKE_CURRENT_BINARY_DIR}/restart/${name} --ranks ${arg_RANKS}
    --kills ${arg_KILLS})
  kedge_append_options(command --set ${arg_SET})
  kedge_add_test(${name} COMMAND ${command} ${scene}
    LABELS scene restart RANKS ${arg_RANKS} TIMEOUT ${arg_TIMEOUT})
endfunction()
