find_package(rapidcheck REQUIRED)
list(APPEND libraries TBB::tbb rapidcheck)
