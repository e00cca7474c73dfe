list(APPEND libraries atrium_geometry TBB::tbb)
