#pragma once

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

namespace ACS::Testing
{

/// A folder that is removed with the object, with all its files.
class TemporaryFolder
{
    std::filesystem::path _path;

public:
    TemporaryFolder()
    {
        std::string pattern = (std::filesystem::temp_directory_path() / "acs-test-XXXXXX").string();
        if (mkdtemp(pattern.data()) == nullptr)
        {
            throw std::runtime_error("cannot make a temporary folder");
        }
        _path = pattern;
    }

    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    ~TemporaryFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(_path, ignored);
    }

    [[nodiscard]] const std::filesystem::path& GetPath() const noexcept
    {
        return _path;
    }
};

} // namespace ACS::Testing
