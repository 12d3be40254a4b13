#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

/// Feeds every file of the given folders to a fuzz target, without libFuzzer: earlier findings stay tested, with
/// either compiler. A rule that is violated ends the program.
int main(int argumentCount, char** arguments)
{
    std::size_t count = 0;
    for (int index = 1; index < argumentCount; ++index)
    {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(arguments[index]))
        {
            if (entry.is_regular_file())
            {
                std::ifstream file(entry.path(), std::ios::binary);
                const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
                std::printf("%s\n", entry.path().c_str());
                std::fflush(stdout); // the last line names the file that ended the program
                // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast)
                static_cast<void>(
                    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
                ++count;
            }
        }
    }
    std::printf("%zu inputs\n", count);
    return count == 0 ? 1 : 0;
}
