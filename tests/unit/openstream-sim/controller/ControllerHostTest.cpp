#include "controller/HostFixture.hpp"
#include "programs/ProgramFile.hpp"
#include "TemporaryFolder.hpp"
#include "world/WorldFile.hpp"

#include <boost/asio/steady_timer.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

using namespace ACS::OpenStream;    // NOLINT(google-build-using-namespace)
using namespace ACS::OpenStreamSim; // NOLINT(google-build-using-namespace)
using Fixture = ACS::Testing::HostFixture;
using namespace std::chrono_literals;

namespace
{

/// As fast as real, and a program waits in playback.
ControllerOptions MakePlayingOptions()
{
    ControllerOptions options;
    options.bWaiting = true;
    options.version = FIRST_WITH_TRAJECTORY_MODE;
    return options;
}

/// Streams points of axis 1 to the arm, and watches where it is.
class PointStream final
{
    Fixture& _fixture;
    boost::asio::steady_timer _timer;

public:
    explicit PointStream(Fixture& fixture)
        : _fixture(fixture),
          _timer(fixture.context)
    {
    }

    /// Begins to send this number of points, evenly from one angle to another, 2 ms apart.
    void Start(double from, double to, int count)
    {
        _timer.expires_after(2ms);
        AwaitPoint(from, (to - from) / count, 1, count);
    }

    /// The first angle of each sample of joint_states.
    [[nodiscard]] std::vector<double> GetAngles() const
    {
        constexpr std::string_view KEY = "\"position\":[";
        std::vector<double> angles;
        for (const ClientEvent& event : _fixture.events)
        {
            const auto* const dataOrNull = std::get_if<ClientData>(&event);
            if (dataOrNull != nullptr)
            {
                const std::string text = dataOrNull->line.result.value_or(ACS::Core::JsonText()).GetText();
                angles.push_back(std::stod(text.substr(text.find(KEY) + KEY.size())));
            }
        }
        return angles;
    }

    /// Until the newest sample's first angle lies there.
    [[nodiscard]] bool TryAwaitAngle(double lowest, double highest)
    {
        return _fixture.TryRunUntil([this, lowest, highest]() {
            const std::vector<double> angles = GetAngles();
            return !angles.empty() && angles.back() >= lowest && angles.back() <= highest;
        });
    }

private:
    void AwaitPoint(double from, double step, int number, int count)
    {
        _timer.async_wait([this, from, step, number, count](const boost::system::error_code& error) {
            if (error)
            {
                return;
            }
            SendPoint(from + step * number, 0.002 * number);
            if (number < count)
            {
                _timer.expires_at(_timer.expiry() + 2ms);
                AwaitPoint(from, step, number + 1, count);
            }
        });
    }

    void SendPoint(double angle, double time) const
    {
        const std::string body = R"({"interval":0.002,"time_from_start":)" + std::to_string(time)
            + R"(,"look_ahead_time":0.04,"point":[)" + std::to_string(angle) + ",90,0,0,0,0]}";
        static_cast<void>(_fixture.client->SendControl(
            ControlRequest{
                EApiMethod::Post,
                "/project/robot/trajectory/joint_traject_insert_point",
                {},
                ACS::Core::JsonText::FromTrusted(body)},
            EControlTracking::Streamed));
    }
};

constexpr const char* INSERT_POINT = "/project/robot/trajectory/joint_traject_insert_point";
/// A point that is to be reached in a minute.
constexpr const char* FAR = R"({"interval":60,"look_ahead_time":0,"point":[90,90,0,0,0,0]})";
constexpr const char* STOP_CONTROL = "{\"cmd\":\"STOP\",\"payload\":{\"target\":\"control\"}}\n";

bool IsMoving(Fixture& fixture)
{
    return fixture.GetOverHTTP("/project/robot/trajectory/joint_traject_mode").find("true") != std::string::npos;
}

bool IsAccepted(const ClientControlSettled& settled)
{
    return settled.outcome == EControlOutcome::Accepted;
}

bool Contains(const std::string& text, const std::string& part)
{
    INFO(text);
    CHECK(text.find(part) != std::string::npos);
    return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("3 A program is started by CONTROL, MONITOR shows its counters rise, HTTP sees the same controller")
{
    Fixture fixture;
    fixture.Monitor("/project/robot/motor_on_state", "{}");
    REQUIRE(fixture.TryAwaitSample(R"({"_type":"JObject","val":1})"));
    REQUIRE(fixture.Control("/project/robot/start", "{}").status == 403); // the motor is off
    REQUIRE(IsAccepted(fixture.Control("/project/robot/motor_on", "{}")));
    REQUIRE(fixture.TryAwaitSample(R"({"_type":"JObject","val":0})"));

    fixture.Monitor("/project/plc/m/val_s32", R"({"st":400,"len":4})");
    REQUIRE(fixture.TryAwaitSample("[0,0,0,0]"));
    REQUIRE(IsAccepted(fixture.Control("/project/context/tasks[0]/cur_prog_cnt", R"({"pno":11,"ext_sel":1})")));
    REQUIRE(Contains(fixture.GetOverHTTP("/project/rgen"), R"("cur_prog_no":11)"));
    REQUIRE(IsAccepted(fixture.Control("/project/robot/start", "{}")));
    REQUIRE(fixture.TryAwaitSample("[1,0,0,0]"));
    REQUIRE(fixture.TryAwaitSample("[1,1,0,11]"));
    REQUIRE(Contains(fixture.GetOverHTTP("/project/plc/m/val_s32?st=400&len=4"), "\r\n\r\n[1,1,0,11]"));
}

TEST_CASE(
    "C.2 C.4 A client streams points by CONTROL at 2 ms and sees the arm follow in MONITOR, until STOP control holds it")
{
    constexpr int POINTS = 150;
    constexpr double MIDDLE = 3.0; // deg
    constexpr double LAST = 6.0;   // deg
    Fixture fixture({}, MakePlayingOptions());
    PointStream points(fixture);
    fixture.Monitor("/project/robot/joints/joint_states", R"({"jno_start":1,"jno_n":1})", 2ms);
    REQUIRE(points.TryAwaitAngle(0.0, 0.0));
    REQUIRE(IsAccepted(fixture.Control("/project/robot/trajectory/joint_traject_init", "{}")));
    points.Start(0.0, MIDDLE, POINTS);
    REQUIRE(points.TryAwaitAngle(MIDDLE - 1e-4, MIDDLE + 1e-4));
    points.Start(MIDDLE, LAST, POINTS);
    REQUIRE(points.TryAwaitAngle(LAST - 1e-4, LAST + 1e-4));
    // No sample lay beyond, and none went back.
    const std::vector<double> angles = points.GetAngles();
    for (std::size_t i = 1; i < angles.size(); ++i)
    {
        REQUIRE(angles[i] >= angles[i - 1] - 1e-9);
        REQUIRE(angles[i] <= LAST + 1e-4);
    }
    REQUIRE(Contains(
        fixture.GetOverHTTP("/project/robot/trajectory/joint_traject_buf_avail"),
        R"({"_type":"JObject","val":2048})"));

    // STOP control drops this one.
    REQUIRE(IsAccepted(fixture.Control(INSERT_POINT, FAR)));
    REQUIRE(points.TryAwaitAngle(LAST + 0.01, 90.0));
    fixture.client->StopControl();
    REQUIRE(fixture.TryRunUntil(
        [&fixture]() { return fixture.GetSample().find(R"("velocity":[0])") != std::string::npos; }));
    REQUIRE(Contains(
        fixture.GetOverHTTP("/project/robot/trajectory/joint_traject_mode"),
        R"({"_type":"JObject","mode":false})"));
    REQUIRE(points.GetAngles().back() < 90.0);
}

TEST_CASE("C.4 STOP control of a client without CONTROLs drops the points that came over HTTP")
{
    Fixture fixture({}, MakePlayingOptions());
    REQUIRE(fixture.TryAwaitCount<ClientReady>(1));
    REQUIRE(Contains(fixture.PostOverHTTP(INSERT_POINT, FAR), "HTTP/1.1 200 "));
    REQUIRE(IsMoving(fixture));
    fixture.client->StopControl();
    REQUIRE(fixture.TryAwaitCount<ClientStopped>(1));
    REQUIRE(Contains(
        fixture.GetOverHTTP("/project/robot/trajectory/joint_traject_buf_avail"),
        R"({"_type":"JObject","val":2048})"));
    REQUIRE_FALSE(IsMoving(fixture));
}

TEST_CASE("C.4 STOP control of a client without CONTROLs stops nothing while another client controls the robot")
{
    Fixture fixture({}, MakePlayingOptions());
    REQUIRE(fixture.TryAwaitCount<ClientReady>(1));
    REQUIRE(IsAccepted(fixture.Control(INSERT_POINT, FAR)));
    REQUIRE(IsMoving(fixture));
    REQUIRE(Contains(fixture.SendLines(STOP_CONTROL), "nothing_to_stop"));
    REQUIRE(IsMoving(fixture));

    // With its session, the other client loses the control, and its motion is left.
    fixture.client->Stop();
    REQUIRE(fixture.TryAwaitCount<ClientEnded>(1));
    REQUIRE(IsMoving(fixture));
    REQUIRE(Contains(fixture.SendLines(STOP_CONTROL), "nothing_to_stop"));
    REQUIRE_FALSE(IsMoving(fixture));
}

TEST_CASE("A Over HTTP the encoded path, the status and the content type are right")
{
    Fixture fixture;
    const std::string body = R"({"pno":12,"ext_sel":1})";
    const std::string selected = fixture.SendHTTP(
        "POST /project/context/tasks%5B0%5D/cur_prog_cnt HTTP/1.1\r\nHost: sim\r\nConnection: close\r\n"
        "Content-Type: text/plain\r\nContent-Length: "
        + std::to_string(body.size()) + "\r\n\r\n" + body);
    REQUIRE(Contains(selected, "HTTP/1.1 200 "));
    REQUIRE(Contains(selected, "application/json; charset=utf-8"));
    REQUIRE(Contains(selected, "sno_new"));
    REQUIRE(Contains(fixture.GetOverHTTP("/project/robot"), R"("cur_prog_no":12)"));
    const std::string missing = fixture.GetOverHTTP("/project/nothing");
    REQUIRE(Contains(missing, "HTTP/1.1 404 "));
    REQUIRE(Contains(missing, R"("err_code":-2)"));
}

TEST_CASE("A program moves its carrier after its client has disconnected: the journal lists the move")
{
    const ACS::Testing::TemporaryFolder folder;
    const std::string file = folder.GetPath() / "world.json";
    std::ofstream(file) << R"({"version":1,"carriers":{"TRAY_01":"CR01.TP01"}})";
    const auto world = ACS::Sim::WorldFile::Open(file);
    REQUIRE(world.has_value());
    ControllerOptions options = Fixture::MakeFastOptions();
    options.programs =
        ProgramFile::ReadText("[11]\nfrom = [\"CR01.TP01\"]\nto = [\"CR01.TP02\"]", "programs.toml").programs;
    options.robotID = "CR01";
    options.world = world->get();
    options.bMotorOn = true;
    Fixture fixture({}, options);
    fixture.Monitor("/project/robot/motor_on_state", "{}");
    REQUIRE(fixture.TryAwaitSample(R"({"_type":"JObject","val":0})"));
    REQUIRE(IsAccepted(fixture.Control("/project/context/tasks[0]/cur_prog_cnt", R"({"pno":11,"ext_sel":1})")));
    REQUIRE(IsAccepted(fixture.Control("/project/robot/start", "{}")));
    fixture.client.reset();
    const std::string moved =
        R"({"event":"CarrierMoved","robot":"CR01","carrier":"TRAY_01","from":"CR01.TP01","to":"CR01.TP02"})";
    REQUIRE(fixture.TryRunUntil([&file, &moved]() {
        std::ifstream journal(file + ".journal");
        return std::string(std::istreambuf_iterator<char>(journal), {}) == moved + "\n";
    }));
}

TEST_CASE("7.28 A MONITOR of an unknown path continues and reports 404 with every sample")
{
    Fixture fixture;
    fixture.Monitor("/project/nothing", "{}");
    const auto countTold = [&fixture]() {
        return std::ranges::count_if(fixture.events, [](const ClientEvent& event) {
            const auto* const dataOrNull = std::get_if<ClientData>(&event);
            return dataOrNull != nullptr && dataOrNull->line.status == 404;
        });
    };
    REQUIRE(fixture.TryRunUntil([&countTold]() { return countTold() >= 3; }));
    fixture.Monitor("/api_ver", "{}");
    REQUIRE(fixture.TryAwaitSample("5"));
}

TEST_CASE("1 A port in use of the Open API is named; without it nothing is served")
{
    Fixture fixture;
    HostOptions options;
    options.stream.port = 0;
    options.http = fixture.host->GetHttpEndpoint();
    const std::unique_ptr<ControllerHost> second = fixture.MakeHost(options);
    const ACS::Core::Result<void> started = second->Start();
    REQUIRE_FALSE(started.has_value());
    REQUIRE(Contains(ACS::Core::Describe(started.error()), MakeText(options.http)));
    REQUIRE(second->GetStreamEndpoint().port == 0);
}
