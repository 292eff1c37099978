# The scenes that are run as tests; kedge_add_scene_test is explained in
# kedge_tests.cmake.
