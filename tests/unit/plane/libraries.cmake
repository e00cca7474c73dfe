list(APPEND libraries TBB::tbb atrium_synth atrium_normal)
