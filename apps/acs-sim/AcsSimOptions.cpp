#include "AcsSimOptions.hpp"

#include "faults/EFault.hpp"
#include <acs/core/Result.hpp>
#include <acs/core/RobotID.hpp>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace ACS::AcsSim
{

namespace
{

// The readers return an empty text, or what is wrong with the value.

constexpr std::size_t MAX_PLANS = 1'000'000;

std::string ReadRobot(const std::string& text, std::vector<std::string>& robots)
{
    const bool bType = text.starts_with("LR") || text.starts_with("CR");
    if (!bType || !Core::RobotID::Parse(text).has_value())
    {
        return fmt::format(
            "expected the id of a robot that begins with LR or CR (LR01), found {}",
            Core::QuoteForError(text));
    }
    if (std::ranges::find(robots, text) != robots.end())
    {
        return fmt::format("robot {} is given twice", text);
    }
    robots.push_back(text);
    return {};
}

std::string ReadFault(const std::string& text, std::vector<FaultOrder>& faults)
{
    const std::optional<FaultOrder> order = ReadFaultOrderOrNull(text);
    if (!order.has_value())
    {
        return fmt::format(
            "expected NAME, NAME=COUNT or NAME=always with one of {}; found {}",
            ListFaults(),
            Core::QuoteForError(text));
    }
    faults.push_back(*order);
    return {};
}

std::string ReadHeader(const std::string& text, ProtocolBeast::HttpHeaders& headers)
{
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos || colon == 0)
    {
        return "expected NAME: VALUE, found " + Core::QuoteForError(text);
    }
    const std::size_t value = text.find_first_not_of(' ', colon + 1);
    headers.emplace_back(text.substr(0, colon), value == std::string::npos ? std::string() : text.substr(value));
    return {};
}

void AddLinkOptions(CLI::App& app, AcsSimOptions& options)
{
    Apps::AddUrlOption(app, "--url", options.url, {Apps::EUrlScheme::Ws, Apps::EUrlScheme::Wss}, "URL of the MCS");
    Apps::AddRepeatedOption(
        app,
        "--header",
        [&options](const std::string& text) { return ReadHeader(text, options.headers); },
        "Additional header of the upgrade, for example 'Authorization: Bearer TOKEN'; may be repeated")
        .type_name("'NAME: VALUE'");
    Apps::AddFileOption(
        app,
        "--tls-ca",
        options.tls.caFile,
        "With wss: the CA of the server's certificate (default: those of the system)")
        .type_name("FILE.pem");
    Apps::AddFileOption(app, "--tls-certificate", options.tls.certificateFile, "With wss: the certificate of the ACS")
        .type_name("FILE.pem");
    Apps::AddFileOption(
        app,
        "--tls-key",
        options.tls.keyFile,
        "The private key of --tls-certificate, without a passphrase")
        .type_name("FILE.pem");
}

} // namespace

std::optional<int> ParseOptionsOrNull(int argc, const char* const* argv, AcsSimOptions& options)
{
    CLI::App app{
        "Simulates an ACS and judges the MCS that it connects to: executes its plans, makes errors on request, and prints a "
        "table of the rules of MCS-ACS 1.4.1. Exit code 0 if no rule was violated, the MCS has accepted the registration and "
        "all plans of --plans have ended; otherwise 1; 2 for an invalid command line.",
        std::string(PROGRAM_NAME)};
    AddLinkOptions(app, options);
    Apps::AddRepeatedOption(
        app,
        "--robot",
        [&options](const std::string& text) { return ReadRobot(text, options.robots); },
        "Robot of the ACS: LR… moves cassettes, CR… trays and memories; may be repeated (default LR01 and CR01)")
        .type_name("NAME");
    Apps::AddRepeatedOption(
        app,
        "--fault",
        [&options](const std::string& text) { return ReadFault(text, options.faults); },
        "Error of the ACS, once, COUNT times or always; may be repeated. Names: " + ListFaults())
        .type_name("NAME[=COUNT]");
    Apps::AddCountOption(
        app,
        "--plans",
        options.plans,
        {0, MAX_PLANS},
        "End when this number of plans have ended and all faults have occurred (default 0: no limit)");
    Apps::AddDurationOption(
        app,
        "--for",
        options.duration,
        "End after this time, for example 30s (default: at SIGINT or SIGTERM)");
    Apps::AddDurationOption(app, "--ack-timeout", options.ackTimeout, "Maximum time of the MCS to an Ack (default 5s)");
    Apps::AddCountOption(
        app,
        "--queue",
        options.queue,
        {0, MAX_PLANS},
        "Maximum number of plans that wait; others are refused with Queue Full; 0 refuses all (default 100)");
    Apps::AddTimeScaleOption(app, options.timeScale);
    Apps::AddCommonOptions(app, options.common);
    const std::optional<int> exitCode = Apps::ParseCommandLineOrNull(app, argc, argv);
    if (exitCode.has_value())
    {
        return exitCode;
    }
    if (options.tls != ProtocolBeast::TlsOptions() && !Apps::IsSecure(options.url.scheme))
    {
        Apps::PrintError(PROGRAM_NAME, "--tls-ca, --tls-certificate and --tls-key need a wss:// URL");
        return Apps::EXIT_BAD_COMMAND_LINE;
    }
    return std::nullopt;
}

} // namespace ACS::AcsSim
