list(APPEND libraries atrium_geometry atrium_filter atrium_synth atrium_scene TBB::tbb nlohmann_json::nlohmann_json)
list(APPEND alone glb_test.cpp glb_textures_test.cpp)
