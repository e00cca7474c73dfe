list(APPEND libraries atrium_geometry atrium_align atrium_segment atrium_estimate atrium_refine TBB::tbb)
