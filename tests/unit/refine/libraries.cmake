list(APPEND libraries atrium_geometry atrium_segment atrium_estimate TBB::tbb)
