#include "Catch.hpp"
#include "CertificateMaker.hpp"
#include "config/AcsdConfig.hpp"
#include "ExampleSite.hpp"
#include "TemporaryFolder.hpp"

#include <filesystem>
#include <fstream>
#include <string>

namespace ACS::Acsd::Test
{

namespace
{

using std::filesystem::perms;

void SetReadableByAll(const std::string& file, bool bReadable)
{
    std::filesystem::permissions(
        file,
        bReadable ? perms::owner_read | perms::owner_write | perms::others_read
                  : perms::owner_read | perms::owner_write);
}

} // namespace

TEST_CASE("operator.tokens_file has valid lines, and not every user can read it")
{
    const Testing::TemporaryFolder folder;
    const std::string file = (folder.GetPath() / "tokens").string();
    std::ofstream(file) << "operator kim " << std::string(64, 'a') << '\n';
    const std::string override = "operator.tokens_file=" + file;
    SetReadableByAll(file, false);
    const AcsdConfig config = ReadSite({override});
    CHECK(config.errors.empty());
    REQUIRE(config.http.control.access.tokens.has_value());
    CHECK(config.http.control.access.tokens->size() == 1);
    SetReadableByAll(file, true);
    CheckErrors(
        {{{override}, "operator.tokens_file: every user of this machine can read " + file + "; run chmod o-rwx "}});
    SetReadableByAll(file, false);
    std::ofstream(file) << "operator kim secret\n";
    CheckErrors({{{override}, "operator.tokens_file: " + file + ": expected "}});
}

TEST_CASE("A tokens file without a token, with which no operator has access, is reported and permitted")
{
    const Testing::TemporaryFolder folder;
    const std::string file = (folder.GetPath() / "tokens").string();
    std::ofstream(file) << "";
    SetReadableByAll(file, false);
    const AcsdConfig config = ReadSite({"operator.tokens_file=" + file});
    CHECK(config.errors.empty());
    const std::string expected = "operator.tokens_file: " + file + " has no token, so every token is refused";
    CHECK(std::ranges::any_of(config.warnings, [&](const std::string& text) { return text.starts_with(expected); }));
}

TEST_CASE("A key of operator.tls that every user can read is rejected")
{
    const Testing::TemporaryFolder folder;
    Testing::CertificateMaker maker(folder.GetPath());
    const Testing::CertificateFiles files = maker.MakeSelfSigned({});
    const std::string certificate = "operator.tls.certificate=" + files.certificate;
    const std::string key = "operator.tls.key=" + files.key;
    SetReadableByAll(files.key, false);
    CHECK(ReadSite({certificate, key}).errors.empty());
    SetReadableByAll(files.key, true);
    CheckErrors({{{certificate, key}, "operator.tls.key: every user of this machine can read " + files.key}});
}

} // namespace ACS::Acsd::Test
