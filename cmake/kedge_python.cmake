# The Python module: `import kedge` with <build>/python in PYTHONPATH. Built where pybind11 and
# Python's headers are, as Debian's pybind11-dev and python3-dev have them; never required.

# the system's Python, for which its numpy and matplotlib are, before others in PATH
if(NOT DEFINED Python_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python QUIET COMPONENTS Interpreter Development.Module)
set(PYBIND11_NOPYTHON ON) # its headers are all that is needed
find_package(pybind11 2.9 QUIET CONFIG)
if(Python_Development.Module_FOUND AND pybind11_FOUND AND NOT KEDGE_SANITIZE)
  set(python_is_there ON)
else()
  set(python_is_there OFF)
endif()
option(KEDGE_PYTHON "Build the Python module (needs pybind11 and Python's headers)"
  ${python_is_there})
if(NOT KEDGE_PYTHON)
  return()
endif()
if(NOT python_is_there)
  message(FATAL_ERROR "KEDGE_PYTHON needs pybind11 and Python's headers (on Debian: apt-get "
    "install pybind11-dev python3-dev), and no sanitizer")
endif()

set(python_folder ${PROJECT_BINARY_DIR}/python)
file(GLOB python_files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/source/python/kedge/*.py)
foreach(file IN LISTS python_files)
  get_filename_component(name ${file} NAME)
  configure_file(${file} ${python_folder}/kedge/${name} COPYONLY)
endforeach()

Python_add_library(kedge_python MODULE WITH_SOABI source/python/bindings.cc)
set_target_properties(kedge_python PROPERTIES OUTPUT_NAME _core
  LIBRARY_OUTPUT_DIRECTORY ${python_folder}/kedge INSTALL_RPATH_USE_LINK_PATH ON)
target_link_libraries(kedge_python PRIVATE kedge::kedge pybind11::headers)
# no header of deal.II, none of its flags: they would double the time that this file takes
target_compile_options(kedge_python PRIVATE -Wall -Wextra -Werror -O1 -g0)

# where Debian's Python looks, if the prefix is /usr
set(KEDGE_PYTHON_FOLDER lib/python3/dist-packages CACHE STRING
  "Where cmake --install puts the Python module, below the prefix")
install(TARGETS kedge_python LIBRARY DESTINATION ${KEDGE_PYTHON_FOLDER}/kedge)
install(FILES ${python_files} DESTINATION ${KEDGE_PYTHON_FOLDER}/kedge)
