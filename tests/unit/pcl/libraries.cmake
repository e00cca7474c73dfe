list(APPEND libraries atrium_filter atrium_geometry atrium_io atrium_normal atrium_object atrium_plane atrium_register TBB::tbb)
