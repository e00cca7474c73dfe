find_package(rapidcheck REQUIRED)
list(APPEND libraries TBB::tbb atrium_synth atrium_normal rapidcheck)
