# find_package(carom 0.2): the target carom::carom, the simulator without pictures and files.
include(CMakeFindDependencyMacro)
find_dependency(Eigen3 3.4 NO_MODULE)
find_dependency(yaml-cpp 0.7)
find_dependency(fmt 9.1)
include(${CMAKE_CURRENT_LIST_DIR}/carom-targets.cmake)
