# find_package(aibo_client) gives the target aibo_client::aibo_client.
include(CMakeFindDependencyMacro)
find_dependency(Threads)
include(${CMAKE_CURRENT_LIST_DIR}/aibo_clientTargets.cmake)
