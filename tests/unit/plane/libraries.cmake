list(APPEND libraries TBB::tbb)
