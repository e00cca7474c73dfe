find_package(rapidcheck REQUIRED)
list(APPEND libraries rapidcheck nlohmann_json::nlohmann_json)
