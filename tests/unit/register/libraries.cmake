list(APPEND libraries TBB::tbb atrium_io)
