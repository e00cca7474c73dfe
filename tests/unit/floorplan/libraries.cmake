find_package(PNG REQUIRED)
list(APPEND libraries TBB::tbb nlohmann_json::nlohmann_json PNG::PNG)
