#include "Catch.hpp"
#include "config/AcsdConfig.hpp"
#include "replay/RecordedConfig.hpp"
#include "TemporaryFolder.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

/// The example site with this text as the table of the store.
class StoreSite
{
    Testing::TemporaryFolder _folder;

public:
    StoreSite()
    {
        for (const char* name : {"site.lif.json", "acsd.toml"})
        {
            std::filesystem::copy_file(std::filesystem::path(ACS_SITE) / name, _folder.GetPath() / name);
        }
    }

    [[nodiscard]] std::string Write(const std::string& name, const std::string& text) const
    {
        const std::filesystem::path path = _folder.GetPath() / name;
        std::ofstream(path) << text;
        std::filesystem::permissions(path, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
        return path.string();
    }

    [[nodiscard]] AcsdConfig Read(const std::string& store, const std::vector<std::string>& overrides = {}) const
    {
        std::ifstream in(std::filesystem::path(ACS_SITE) / "acsd.toml");
        std::string text{std::istreambuf_iterator<char>(in), {}};
        const std::string line = "directory = \"store\"";
        text.replace(text.find(line), line.size(), store + " #");
        return ReadAcsdConfig(Write("acsd.toml", text), overrides);
    }
};

std::string Join(const std::vector<std::string>& lines)
{
    std::string text;
    for (const std::string& line : lines)
    {
        text += line + "\n";
    }
    return text;
}

constexpr const char* AUDIT = "operator.audit.directory=audit";

} // namespace

TEST_CASE("A store is in a directory or in PostgreSQL")
{
    const StoreSite site;
    CHECK_FALSE(site.Read("directory = 's'").store.postgres.has_value());
    const AcsdConfig shared =
        site.Read("url = 'postgresql://kim@127.0.0.1/acs'\ninstance = 'a'\nlease = '5s'", {AUDIT});
    CHECK(shared.errors.empty());
    CHECK(shared.warnings.empty());
    REQUIRE(shared.store.postgres.has_value());
    CHECK(shared.store.GetName() == "postgresql://kim@127.0.0.1/acs");
    CHECK(shared.store.instance == "a");
    CHECK(shared.store.lease == std::chrono::seconds(5));
    CHECK_THAT(
        Join(site.Read("directory = 's'\nurl = 'postgresql://kim@127.0.0.1/acs'", {AUDIT}).errors),
        Catch::Contains("store.directory") && Catch::Contains("delete one of them"));
    CHECK_THAT(
        Join(site.Read("directory = 's'\nlease = '5s'").errors),
        Catch::Contains("store.lease") && Catch::Contains("belongs to store.url"));
    CHECK_THAT(Join(site.Read("").errors), Catch::Contains("store.directory"));
    CHECK_THAT(
        Join(site.Read("url = 'postgresql://kim@127.0.0.1/acs'").errors),
        Catch::Contains("operator.audit.directory") && Catch::Contains("is required with store.url"));
    CHECK_THAT(Join(site.Read("url = 'mysql://db/acs'", {AUDIT}).errors), Catch::Contains("store.url"));
    CHECK_THAT(
        Join(site.Read("url = 'postgresql://kim@127.0.0.1/acs'\nlease = '100ms'", {AUDIT}).errors),
        Catch::Contains("store.lease"));
}

TEST_CASE("The password of a store is not shown and not readable by others")
{
    const StoreSite site;
    const std::string file = site.Write("password", "s3cret\nnext line\n");
    const AcsdConfig config = site.Read("url = 'postgresql://kim@127.0.0.1/acs'\npassword_file = 'password'", {AUDIT});
    CHECK(config.errors.empty());
    CHECK(config.store.postgres.value().password == "s3cret");
    std::filesystem::permissions(file, std::filesystem::perms::others_read, std::filesystem::perm_options::add);
    CHECK_THAT(
        Join(site.Read("url = 'postgresql://kim@127.0.0.1/acs'\npassword_file = 'password'", {AUDIT}).errors),
        Catch::Contains("store.password_file") && Catch::Contains("chmod o-rwx"));
    const AcsdConfig inURL = site.Read("url = 'postgresql://kim:s3cret@db.plant/acs?sslmode=require'", {AUDIT});
    CHECK(inURL.store.GetName() == "postgresql://kim@db.plant/acs");
    CHECK_THAT(Join(inURL.warnings), Catch::Contains("does not identify the server") && !Catch::Contains("s3cret"));
    CHECK_THAT(MakeRecordedConfig(inURL), !Catch::Contains("s3cret"));
}

TEST_CASE("Processes agree about site, robots and options, and not about addresses and logs")
{
    const StoreSite site;
    const std::string url = "url = 'postgresql://kim@127.0.0.1/acs'";
    const std::string first = MakeConfigFingerprint(site.Read(url, {AUDIT}));
    CHECK(first.size() == 64);
    CHECK(
        MakeConfigFingerprint(site.Read(
            "url = 'postgresql://lee@db.plant/acs'\ninstance = 'b'",
            {AUDIT, "http.listen=127.0.0.1:0", "log.level=debug", "mqtt.url=mqtt://10.0.0.1:1883"}))
        == first);
    CHECK(MakeConfigFingerprint(site.Read(url, {AUDIT, "outbox.max=5000"})) != first);
    static_cast<void>(site.Write("site.lif.json", "{}"));
    CHECK(MakeConfigFingerprint(site.Read(url, {AUDIT})) != first);
}

} // namespace ACS::Acsd::Test
