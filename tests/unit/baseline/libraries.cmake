find_package(rapidcheck REQUIRED)
list(APPEND libraries atrium_geometry atrium_metric TBB::tbb rapidcheck)
