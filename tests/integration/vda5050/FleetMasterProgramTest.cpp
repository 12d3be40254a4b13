#include "Catch.hpp"
#include "ChildProcess.hpp"
#include "LinkedVehicle.hpp"
#include "TemporaryFolder.hpp"
#include <acs/vda5050/Vda5050Codec.hpp>

#include <boost/asio/steady_timer.hpp>

#include <csignal>
#include <fstream>

namespace ACS::Testing
{
namespace
{

using namespace std::chrono_literals;
using namespace VDA5050; // NOLINT(google-build-using-namespace): nearly every name of the test is one of it
using VDA5050::Test::MakeAction;
using VDA5050::Test::MakeEdges;
using VDA5050::Test::MakeNodes;

constexpr std::size_t FEWEST_MESSAGES = 4; ///< Of order-1 over five nodes and order-2; more where it drives slowly.

/// examples/e10_fleet_master in a process that is killed, and a vehicle in this process.
class FleetMasterTest
{
protected:
    boost::asio::io_context _context;
    MosquittoBroker _broker;
    TemporaryFolder _folder;
    std::unique_ptr<LinkedVehicle> _vehicle;
    std::unique_ptr<ChildProcess> _master;
    boost::asio::steady_timer _tick{_context};

    FleetMasterTest()
    {
        Tick();
    }

    /// The loop does not watch the pipe of the master: the output is polled.
    void Tick()
    {
        _tick.expires_after(10ms);
        _tick.async_wait([this](const boost::system::error_code& error) {
            if (!error)
            {
                Tick();
            }
        });
    }

    void StartVehicle()
    {
        _vehicle = std::make_unique<LinkedVehicle>(
            _context,
            MakeOptions(_broker.GetPort(), "vehicle"),
            LinkedVehicle::MakeOptions(EVda5050Version::Version200));
    }

    [[nodiscard]] std::filesystem::path GetJournal() const
    {
        return _folder.GetPath() / "fleet.journal";
    }

    void WriteCommands(const std::vector<std::string>& commands) const
    {
        std::ofstream file(_folder.GetPath() / "commands");
        for (const std::string& command : commands)
        {
            file << command << '\n';
        }
    }

    void StartMaster(const std::string& script = R"(exec "$0" 127.0.0.1 "$1" "$2" < "$3")")
    {
        _master = std::make_unique<ChildProcess>(std::vector<std::string>{
            "sh",
            "-c",
            script,
            ACS_EXAMPLE,
            std::to_string(_broker.GetPort()),
            GetJournal().string(),
            (_folder.GetPath() / "commands").string()});
    }

    void KillMaster()
    {
        _master->Signal(SIGKILL);
        REQUIRE(_master->WaitForExitOrNull(10s) == 128 + SIGKILL);
    }

    [[nodiscard]] bool WasReached(const std::function<bool()>& isTrue)
    {
        return TryRunUntil(_context, isTrue, 30s);
    }

    [[nodiscard]] bool WasPrinted(std::string_view text)
    {
        return WasReached([&]() { return _master->TryWaitForText(text, 0ms); });
    }

    [[nodiscard]] static std::string MakeCommand(std::string orderID, std::vector<OrderNode> nodes)
    {
        const std::vector<OrderEdge> edges = MakeEdges(nodes.size() - 1);
        OrderMessage order = *OrderBuilder::Create(std::move(orderID), std::move(nodes), edges)->MakeOrder(1);
        order.header.version = "2.0.0";
        const VehicleAddress address = VDA5050::Test::MakeAddress();
        return "order " + address.manufacturer + "/" + address.serialNumber + " "
            + Vda5050Codec().Encode(order, EVda5050Version::Version200);
    }

    /// N0 to N4 with an action on N1 and on N3; then one on the spot.
    [[nodiscard]] static std::vector<std::string> MakeCommands()
    {
        std::vector<OrderNode> nodes = MakeNodes(5);
        nodes[1].actions.push_back(MakeAction("a1", EBlockingType::Hard, "detectObject"));
        nodes[3].actions.push_back(MakeAction("a3", EBlockingType::Soft, "detectObject"));
        std::vector<OrderNode> last{nodes.back()};
        last.front().actions.push_back(MakeAction("b1", EBlockingType::Hard, "detectObject"));
        return {MakeCommand("order-1", nodes), MakeCommand("order-2", last)};
    }

    [[nodiscard]] std::string ReadJournal() const
    {
        std::ifstream journal(GetJournal());
        return {std::istreambuf_iterator<char>(journal), {}};
    }

    /// Each message in the journal.
    [[nodiscard]] std::size_t CountReleases() const
    {
        std::size_t count = 0;
        std::ifstream journal(GetJournal());
        for (std::string line; std::getline(journal, line);)
        {
            count += line.starts_with("release ") ? 1U : 0U;
        }
        return count;
    }

    void CheckDoneOnce()
    {
        REQUIRE(WasPrinted("all orders have ended"));
        CHECK(_master->WaitForExitOrNull(10s) == 0);
        CHECK(_vehicle->CountStarts("a1") == 1);
        CHECK(_vehicle->CountStarts("a3") == 1);
        CHECK(_vehicle->CountStarts("b1") == 1);
        CHECK(CountReleases() >= FEWEST_MESSAGES);
        CHECK(_vehicle->Count<OrderTaken>() == CountReleases());
        CHECK(_vehicle->Count<OrderRefused>() == 0);
        CHECK(_vehicle->GetSession().GetState().errors.empty());
    }
};

} // namespace

TEST_CASE_METHOD(FleetMasterTest, "13 A fleet master that is not killed completes its orders")
{
    WriteCommands(MakeCommands());
    StartMaster();
    StartVehicle();
    _vehicle->LetReach(LinkedVehicle::EVERYWHERE);
    CheckDoneOnce();
    for (const char* const line :
         {"taken: order-1 for ACS/LR01",
          "ACS/LR01: online",
          "ACS/LR01: order-1 update 2 accepted",
          "ACS/LR01: node N4 reached",
          "ACS/LR01: action a3 finished",
          "ACS/LR01: order-1 finished",
          "ACS/LR01: order-2 finished"})
    {
        CHECK_THAT(_master->GetText(), Catch::Contains(line));
    }
}

TEST_CASE_METHOD(
    FleetMasterTest,
    "13 A master killed by SIGKILL after any of its messages loses nothing and repeats nothing")
{
    const auto messages = static_cast<std::size_t>(GENERATE(range(1, 6)));
    CAPTURE(messages);
    TestLink spy(_context, MakeOptions(_broker.GetPort(), "spy"));
    spy.link.Subscribe({{"uagv/v2/+/+/order", 2}, {"uagv/v2/+/+/instantActions", 2}});
    spy.link.Start();
    REQUIRE(WasReached([&]() { return spy.listener.ups == 1; }));
    WriteCommands(MakeCommands());
    StartMaster();
    StartVehicle();
    _vehicle->LetReach(LinkedVehicle::EVERYWHERE);
    // Besides the order messages: one of instant actions, when the vehicle comes online.
    REQUIRE(WasReached([&]() { return spy.listener.messages.size() >= messages; }));
    KillMaster();
    StartMaster(); // with the same commands
    CheckDoneOnce();
}

TEST_CASE_METHOD(
    FleetMasterTest,
    "13 A master killed by SIGKILL at each step of its vehicle continues where the vehicle is")
{
    const std::vector<std::function<bool()>> moments{
        [this]() { return _vehicle->Count<OrderTaken>() >= 1; },
        [this]() { return _vehicle->CountStarts("a1") >= 1; },
        [this]() { return _vehicle->GetSession().GetState().lastNodeSequenceID >= 4; },
        [this]() { return _vehicle->Count<OrderTaken>() >= 4; },
        [this]() { return _vehicle->CountStarts("a3") >= 1; },
        [this]() { return _vehicle->CountStarts("b1") >= 1; },
        [this]() {
            return _vehicle->GetSession().GetState().orderID == "order-2";
        }};
    const std::size_t chosen = GENERATE(range(std::size_t{0}, std::size_t{8})); // the last: all of them, in one run
    CAPTURE(chosen);
    WriteCommands(MakeCommands());
    StartMaster();
    REQUIRE(WasPrinted("taken: order-2"));
    KillMaster(); // with two orders in its journal, and no vehicle
    StartVehicle();
    _vehicle->LetReach(LinkedVehicle::EVERYWHERE);
    WriteCommands({});
    StartMaster();
    for (std::size_t index = 0; index < moments.size(); ++index)
    {
        if (index == chosen || chosen == moments.size())
        {
            REQUIRE(WasReached(moments[index]));
            KillMaster();
            StartMaster();
        }
    }
    CheckDoneOnce();
}

TEST_CASE_METHOD(FleetMasterTest, "5.4 A master killed during a cancel completes it after its restart")
{
    const bool bBeforeCancel = GENERATE(true, false);
    WriteCommands({MakeCommands().front()});
    StartMaster();
    StartVehicle();
    _vehicle->LetReach(2);
    REQUIRE(WasReached([this]() { return _vehicle->CountStarts("a1") == 1; }));
    KillMaster();
    WriteCommands({"cancel ACS/LR01"});
    if (bBeforeCancel)
    {
        _broker.Kill(); // so the command is journalled and nothing is sent
    }
    StartMaster();
    if (bBeforeCancel)
    {
        REQUIRE(WasReached([this]() { return ReadJournal().find("\ncancel ACS/LR01") != std::string::npos; }));
        KillMaster();
        _broker.Restart();
    }
    else
    {
        REQUIRE(WasReached([this]() { return _vehicle->Count<OrderCleared>() == 1; }));
        KillMaster();
    }
    WriteCommands({});
    StartMaster();
    // Printed by the first master if it received the end of the cancel before it was killed.
    REQUIRE(WasPrinted("all orders have ended"));
    const std::string journal = ReadJournal();
    const std::size_t ended = journal.find("\nended ACS/LR01 order-1\n");
    REQUIRE(ended != std::string::npos);
    CHECK(journal.find("\nended", ended + 1) == std::string::npos);
    CHECK(_vehicle->Count<OrderCleared>() == 1);
    CHECK(_vehicle->CountStarts("a3") == 0);
    CHECK(_vehicle->Count<OrderRefused>() == 0);
}

TEST_CASE_METHOD(
    FleetMasterTest,
    "13 An order that the vehicle lost while its master was down is reported as lost and not sent again")
{
    WriteCommands(MakeCommands());
    StartMaster();
    StartVehicle();
    _vehicle->LetReach(2);
    REQUIRE(WasPrinted("ACS/LR01: order-1 update 0 accepted"));
    REQUIRE(WasReached([this]() { return _vehicle->CountStarts("a1") == 1; }));
    KillMaster();
    _vehicle.reset();
    StartVehicle();
    _vehicle->LetReach(LinkedVehicle::EVERYWHERE);
    StartMaster();
    REQUIRE(WasPrinted("ACS/LR01: order-1 lost: the vehicle does not hold it any more"));
    CHECK(_vehicle->CountStarts("a1") == 0);
    CHECK_THAT(_master->GetText(), Catch::Contains("known: order-1 for ACS/LR01"));
}

TEST_CASE_METHOD(FleetMasterTest, "13 A line that a kill has truncated is ignored")
{
    const std::vector<std::string> commands = MakeCommands();
    std::ofstream(GetJournal()) << commands[0] << '\n' << commands[1].substr(0, 50);
    WriteCommands(commands);
    StartMaster();
    StartVehicle();
    _vehicle->LetReach(LinkedVehicle::EVERYWHERE);
    CheckDoneOnce();
    CHECK_THAT(_master->GetText(), Catch::Contains("known: order-1"));
    CHECK_THAT(_master->GetText(), Catch::Contains("taken: order-2"));
}

TEST_CASE_METHOD(FleetMasterTest, "13 A last command without a line end is executed, from a pipe and from a file")
{
    const bool bPipe = GENERATE(false, true);
    StartVehicle();
    _vehicle->LetReach(LinkedVehicle::EVERYWHERE);
    WriteCommands(MakeCommands());
    const std::filesystem::path commands = _folder.GetPath() / "commands";
    std::filesystem::resize_file(commands, std::filesystem::file_size(commands) - 1);
    bPipe ? StartMaster(R"(cat "$3" | "$0" 127.0.0.1 "$1" "$2")") : StartMaster();
    REQUIRE(WasPrinted("taken: order-2"));
    REQUIRE(WasPrinted("all orders have ended"));
}

} // namespace ACS::Testing
