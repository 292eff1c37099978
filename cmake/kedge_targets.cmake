# What every target of kedge itself is compiled with.

# deal.II, warnings as errors, and the flags of the kernels. deal.II's own
# flags come first, so that ours (-O3, less debug information) win.
function(kedge_set_up_target target)
  deal_ii_setup_target(${target})
  target_compile_options(${target} PRIVATE -Wall -Wextra -Werror)
  # deal.II's headers bring in Sacado's numbers and MPI's C++ classes, which kedge never uses: their
  # guards keep them out, and a file compiles in half the time
  target_compile_definitions(${target} PRIVATE SACADO_HPP
    dealii_differentiation_ad_sacado_product_types_h OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX BOOST_DISABLE_PRAGMA_MESSAGE)
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    target_compile_options(${target} PRIVATE -O3 -g1 -fno-math-errno)
  endif()
  if(KEDGE_SANITIZE)
    # -O1: as fast as the watching allows; its guesses about unset variables are no errors
    set(watch -fsanitize=address,undefined -fno-sanitize-recover=undefined)
    target_compile_options(${target} PRIVATE ${watch} -O1 -fno-omit-frame-pointer
      -Wno-error=maybe-uninitialized)
    target_link_options(${target} PRIVATE ${watch})
    get_target_property(type ${target} TYPE)
    if(type STREQUAL "EXECUTABLE")
      target_sources(${target} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/keep_modules.cc)
    endif()
  endif()
  if(KEDGE_NATIVE)
    target_compile_options(${target} PRIVATE -march=native)
  endif()
endfunction()

# Writes kedge/base/version.h at configure time and the revision, which
# changes with every commit, into a source file of its own at build time.
# Sets `result` to the files to add to the library.
function(kedge_generate_version result)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/version.h.in
    ${PROJECT_BINARY_DIR}/include/kedge/base/version.h @ONLY)
  set(revision_source ${PROJECT_BINARY_DIR}/source/base/revision.cc)
  add_custom_target(kedge_revision
    COMMAND ${CMAKE_COMMAND} -D source_folder=${PROJECT_SOURCE_DIR}
      -D output=${revision_source} -P ${PROJECT_SOURCE_DIR}/cmake/write_revision.cmake
    BYPRODUCTS ${revision_source}
    COMMENT "")
  set_source_files_properties(${revision_source} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
  set(${result} ${revision_source} PARENT_SCOPE)
endfunction()

# The rooms that include little more of deal.II than its tensors: their files compile faster
# without the precompiled header than it takes to load. `folder` holds the rooms.
function(kedge_skip_precompiled_header folder)
  set(light base materials python solvers stress time_integration)
  foreach(room IN LISTS light)
    file(GLOB files ${folder}/${room}/*.cc)
    set_source_files_properties(${files} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
  endforeach()
endfunction()
