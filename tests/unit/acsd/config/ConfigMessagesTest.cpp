#include "Catch.hpp"
#include "common/config/TextFile.hpp"
#include "config/AcsdConfig.hpp"
#include "ExampleSite.hpp"
#include "TemporaryFolder.hpp"

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

using Lines = std::vector<std::string>;

/// The errors of the example site without the first line that begins with the text. Each is shown from its key on.
Lines FindErrorsWithout(const std::string& line)
{
    const Testing::TemporaryFolder folder;
    const std::filesystem::path site(ACS_SITE);
    std::filesystem::copy_file(site / "site.lif.json", folder.GetPath() / "site.lif.json");
    std::string text = Apps::ReadTextFile((site / "acsd.toml").string()).value();
    const std::size_t at = text.find("\n" + line);
    REQUIRE(at != std::string::npos);
    text.erase(at, text.find('\n', at + 1) - at);
    const std::string file = (folder.GetPath() / "acsd.toml").string();
    std::ofstream(file) << text;
    Lines errors = ReadAcsdConfig(file, {}).errors;
    for (std::string& error : errors)
    {
        error = error.substr(error.find(": ") + 2);
    }
    return errors;
}

} // namespace

TEST_CASE("A store that is not given is one error")
{
    CHECK(
        FindErrorsWithout("directory = \"store\"")
        == Lines{"store.directory: missing; give the path of a directory, or store.url for a store in PostgreSQL"});
}

} // namespace ACS::Acsd::Test
