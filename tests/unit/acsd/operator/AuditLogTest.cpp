#include "operator/AuditLog.hpp"

#include "Catch.hpp"
#include "FullDisk.hpp"
#include "ManualClock.hpp"
#include "operator/LinesRoute.hpp"
#include "RecordingLogSink.hpp"
#include "TemporaryFolder.hpp"
#include <acs/core/JsonText.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <sys/stat.h>

using namespace ACS; // NOLINT(google-build-using-namespace)
using Acsd::AuditLog;
using Acsd::EOperatorRole;
using Acsd::OperatorIdentity;

namespace
{

const OperatorIdentity KIM{OperatorIdentity::EProof::Token, "kim", EOperatorRole::Operator};

Apps::HttpRequest MakePost(const std::string& target)
{
    Apps::HttpRequest request = *Apps::ParseHttpTarget(target);
    request.method = "POST";
    request.sender.peer = {"10.0.0.7", 40'000};
    return request;
}

struct AuditFixture
{
    Testing::TemporaryFolder folder;
    Testing::ManualClock clock;
    Testing::RecordingLogSink log;
    std::string directory = folder.GetPath() / "audit";
    Apps::TraceLimits limits{4'096, 3};
    std::unique_ptr<AuditLog> audit;

    void Open()
    {
        audit.reset(); // writes its lines
        auto created = AuditLog::Create(directory, limits, clock, Core::Logger(log, "audit"));
        REQUIRE(created.has_value());
        audit = std::move(*created);
    }

    void Write(const std::string& target) const
    {
        const Apps::HttpRequest request = MakePost(target);
        audit->Write({request, KIM, {202, "application/json", "{\"message\":\"done\"}\n"}});
    }

    [[nodiscard]] std::size_t CountFiles() const
    {
        const std::filesystem::directory_iterator files(directory);
        return static_cast<std::size_t>(std::distance(begin(files), end(files)));
    }
};

mode_t GetMode(const std::string& path)
{
    struct stat status = {};
    REQUIRE(::stat(path.c_str(), &status) == 0);
    return status.st_mode & 0777U;
}

} // namespace

TEST_CASE("An entry of the audit log has peer, identity, request and outcome")
{
    const Core::Now now = Testing::ManualClock().GetNow();
    const Apps::HttpRequest request = MakePost("/alarms/clear?robot=LR01&code=%22");
    CHECK(
        Acsd::MakeAuditLine({request, KIM, {202, "application/json", "{\"message\":\"done\"}\n"}}, now)
        == R"({"time":"2025-07-02T12:00:00.000Z","peer":"10.0.0.7:40000","proof":"token","name":"kim","role":"operator",)"
           R"("method":"POST","request":"/alarms/clear?robot=LR01&code=%22","status":202,"answer":{"message":"done"}})");
    const OperatorIdentity local{OperatorIdentity::EProof::Local, "", EOperatorRole::Operator};
    const std::string line = Acsd::MakeAuditLine({request, local, {404, "text/plain", "not \"found\"\n"}}, now);
    CHECK(line.find(R"("proof":"local","name":"")") != std::string::npos);
    CHECK(line.ends_with(R"("status":404,"answer":"not \"found\""})"));
    // Cut, also within a character, and never more than one line.
    const Apps::HttpRequest longer = MakePost("/x?" + std::string(1'020, 'y') + "\xC3\xA4\n" + std::string(9'000, 'z'));
    const std::string cut = Acsd::MakeAuditLine({longer, KIM, {400, "application/json", std::string(9'000, ' ')}}, now);
    CHECK(cut.size() < 3'000);
    CHECK(cut.find('\n') == std::string::npos);
    CHECK(Core::JsonText::IsUtf8(cut));
}

TEST_CASE("An entry of the audit log has the body of a command, but never a token")
{
    const Core::Now now = Testing::ManualClock().GetNow();
    Apps::HttpRequest request = MakePost("/v1/alarms/clear");
    request.body = R"({"robotId":"LR01"})";
    CHECK(
        Acsd::MakeAuditLine({request, KIM, {400, "text/plain", "no"}}, now)
            .find(R"("request":"/v1/alarms/clear","body":"{\"robotId\":\"LR01\"}","status":400)")
        != std::string::npos);
    request.body = std::string(9'000, 'x');
    CHECK(Acsd::MakeAuditLine({request, KIM, {400, "text/plain", "no"}}, now).size() < 2'000);
    request.body = R"({"token":"secret"})";
    CHECK(Acsd::MakeAuditLine({request, KIM, {404, "text/plain", "no"}}, now).find("secret") == std::string::npos);
    CHECK(Acsd::MakeAuditLine({request, KIM, {405, "text/plain", "no"}}, now).find("secret") == std::string::npos);
    for (const unsigned status : {404U, 405U})
    {
        const Apps::HttpRequest wrong = MakePost("/v1/logn?token=secret");
        const std::string line = Acsd::MakeAuditLine({wrong, KIM, {status, "text/plain", "no"}}, now);
        CHECK(line.find(R"("request":"/v1/logn","status":)") != std::string::npos);
        CHECK(line.find("secret") == std::string::npos);
    }
    request = MakePost("/v1/login");
    request.body = R"({"token":"secret"})";
    CHECK(Acsd::MakeAuditLine({request, KIM, {204, "", ""}}, now).find("secret") == std::string::npos);
}

TEST_CASE("The audit log is readable by its owner only, and continues over a restart")
{
    AuditFixture fixture;
    fixture.Open();
    fixture.Open();
    fixture.Write("/tsc/pause");
    fixture.Open();
    fixture.Open(); // without a command in between
    fixture.Write("/tsc/resume");
    CHECK(fixture.CountFiles() == 1);
    CHECK(GetMode(fixture.directory) == 0700);
    CHECK(GetMode(fixture.directory + "/audit-000001.ndjson") == 0600);
    const std::string newest = fixture.audit->GetNewest().GetText(10);
    CHECK(newest.find("/tsc/pause") < newest.find("/tsc/resume"));
    CHECK(std::ranges::count(newest, '\n') == 2);
    CHECK(fixture.audit->GetNewest().GetText(1).find("/tsc/pause") == std::string::npos);
    CHECK(fixture.audit->GetLost() == 0);
}

TEST_CASE("The audit log is bounded: in its files by size and number, in memory by lines")
{
    AuditFixture fixture;
    fixture.Open();
    for (std::size_t i = 0; i < Acsd::MOST_SHOWN_LINES + 5; ++i)
    {
        fixture.Write("/plans/" + std::to_string(i));
    }
    const std::string newest = fixture.audit->GetNewest().GetText(Acsd::MOST_SHOWN_LINES + 5);
    CHECK(std::ranges::count(newest, '\n') == static_cast<std::ptrdiff_t>(Acsd::MOST_SHOWN_LINES));
    CHECK(newest.find("/plans/4\"") == std::string::npos);
    CHECK(newest.find("/plans/5\"") != std::string::npos);
    fixture.Open();
    CHECK(fixture.CountFiles() == 3);
    for (const auto& file : std::filesystem::directory_iterator(fixture.directory))
    {
        CHECK(file.file_size() <= 4'096);
    }
    CHECK(fixture.audit->GetNewest().GetText(1).find("/plans/1004\"") != std::string::npos);
}

TEST_CASE("A line that a crash has cut is neither shown nor continued")
{
    AuditFixture fixture;
    std::filesystem::create_directory(fixture.directory);
    std::ofstream(fixture.directory + "/audit-000007.ndjson") << "{\"whole\":1}\n{\"cu";
    fixture.Open();
    fixture.Write("/tsc/pause");
    CHECK(fixture.audit->GetNewest().GetText(10).starts_with("{\"whole\":1}\n{\"time\":"));
    fixture.Open();
    CHECK(std::filesystem::exists(fixture.directory + "/audit-000008.ndjson"));
}

TEST_CASE("An audit log that cannot be written is logged although no further command follows")
{
    AuditFixture fixture;
    fixture.Open();
    {
        const Testing::FullDisk full(0);
        fixture.Write("/v1/tsc/pause");
        fixture.audit.reset();
    }
    CHECK(fixture.log.Contains(Core::ELogLevel::Error, "the audit log cannot be written"));
}

TEST_CASE("A directory that cannot be written is an error with key and path")
{
    AuditFixture fixture;
    fixture.directory = "/nowhere/audit";
    const auto created =
        AuditLog::Create(fixture.directory, fixture.limits, fixture.clock, Core::Logger(fixture.log, "audit"));
    REQUIRE_FALSE(created.has_value());
    CHECK(created.error().path == "operator.audit.directory");
    CHECK(created.error().found.starts_with("/nowhere/audit: "));
}
