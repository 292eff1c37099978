# cpack -G DEB: a Debian package with the program, its scenes and its tools. To run on
# other machines than this one it must be built with KEDGE_NATIVE=OFF (preset portable).
set(CPACK_PACKAGE_NAME kedge)
set(CPACK_PACKAGE_CONTACT "The maintainers of kedge <maintainers@kedge.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_GENERATOR DEB TGZ)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON) # finds out which libraries it needs
set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3, libopenblas0-pthread")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-matplotlib, python3-numpy, openmpi-bin")
# without the library, which is for those who build on it
set(CPACK_COMPONENTS_ALL Unspecified)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
include(CPack)
