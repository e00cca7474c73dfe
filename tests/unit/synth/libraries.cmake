list(APPEND libraries atrium_geometry atrium_io TBB::tbb)
