#include "Catch.hpp"
#include "CertificateMaker.hpp"
#include "config/AcsdConfig.hpp"
#include "SeededRandom.hpp"
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

AcsdConfig ReadMQTT(const std::vector<std::string>& overrides)
{
    return ReadAcsdConfig(std::string(ACS_SITE) + "/acsd.toml", overrides);
}

/// With mqtt.urls instead of mqtt.url.
AcsdConfig ReadCluster(const std::string& urls, const std::vector<std::string>& overrides = {})
{
    const Testing::TemporaryFolder folder;
    std::filesystem::copy(ACS_SITE, folder.GetPath());
    const std::string path = (folder.GetPath() / "acsd.toml").string();
    std::ifstream input(path);
    std::string text((std::istreambuf_iterator<char>(input)), std::istreambuf_iterator<char>());
    const std::size_t begin = text.find("url = ", text.find("[mqtt]"));
    text.replace(begin, text.find('\n', begin) - begin, "urls = " + urls);
    std::ofstream(path) << text;
    return ReadAcsdConfig(path, overrides);
}

std::string WriteFile(const Testing::TemporaryFolder& folder, const std::string& name, const std::string& text)
{
    std::string path = (folder.GetPath() / name).string();
    std::ofstream(path) << text;
    std::filesystem::permissions(path, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    return path;
}

} // namespace

TEST_CASE("Without further keys the connection to the broker has neither TLS nor a user name")
{
    Testing::SeededRandom random{1};
    const AcsdConfig config = ReadMQTT({});
    const VDA5050::MosquittoOptions options = MakeMqttOptions(config.mqtt.value(), random);
    CHECK(options.host == "127.0.0.1");
    CHECK(options.port == 1883);
    CHECK(options.username.empty());
    CHECK(options.password.empty());
    CHECK_FALSE(options.tls.has_value());
    CHECK(MakeMqttOptions(config.mqtt.value(), random).clientID != options.clientID);
    CHECK(MakeMqttOptions(config.mqtt.value(), random, {"plant", 0, {}}).clientID == "acsd-plant");
    CHECK(config.warnings.empty());
}

TEST_CASE("mqtt.urls has the nodes of a broker cluster in the order of their use")
{
    const Testing::TemporaryFolder folder;
    Testing::SeededRandom random{1};
    const AcsdConfig config = ReadCluster(R"(["mqtt://a:1884", "mqtt://b", "mqtt://[fd00::1]:1885"])");
    REQUIRE(config.errors.empty());
    CHECK(config.warnings.empty());
    const VDA5050::MosquittoOptions options = MakeMqttOptions(config.mqtt.value(), random);
    CHECK(options.host == "a");
    CHECK(options.port == 1884);
    CHECK(options.furtherBrokers == std::vector<VDA5050::MosquittoBroker>{{"b", 1883}, {"fd00::1", 1885}});
    CHECK(options.maxQos == 2);
    CHECK_FALSE(options.tls.has_value());
    const AcsdConfig secure = ReadCluster(R"(["mqtts://a", "mqtts://b"])", {"mqtt.max_qos=1"});
    REQUIRE(secure.errors.empty());
    CHECK(MakeMqttOptions(secure.mqtt.value(), random).tls.has_value());
    CHECK(MakeMqttOptions(secure.mqtt.value(), random).maxQos == 1);

    const std::string password = "mqtt.password_file=" + WriteFile(folder, "password", "s3cret");
    const AcsdConfig plain =
        ReadCluster(R"(["mqtt://127.0.0.1", "mqtt://10.0.0.5", "mqtt://10.0.0.6"])", {"mqtt.username=acs", password});
    CHECK(
        plain.warnings
        == std::vector<std::string>{
            "mqtt.password_file: it is sent to 10.0.0.5 unencrypted; use mqtts://",
            "mqtt.password_file: it is sent to 10.0.0.6 unencrypted; use mqtts://"});
}

TEST_CASE("mqtt.urls that contradict themselves or mqtt.url are one error with the remedy")
{
    const auto getError = [](const AcsdConfig& config) {
        REQUIRE(config.errors.size() == 1);
        return config.errors[0];
    };
    CHECK_THAT(
        getError(ReadMQTT({R"(mqtt.urls=["mqtt://a", "mqtt://b"])"})), // besides the mqtt.url of the file
        Catch::Contains("mqtt.urls: mqtt.url is given too; keep mqtt.url for one broker, or mqtt.urls"));
    CHECK_THAT(getError(ReadCluster("[]")), Catch::Contains("mqtt.urls: is empty"));
    CHECK_THAT(getError(ReadCluster(R"("mqtt://a")")), Catch::Contains("mqtt.urls: expected a list of strings"));
    CHECK_THAT(
        getError(ReadCluster(R"(["mqtt://a", "ws://b"])")),
        Catch::Contains("mqtt.urls: expected a URL mqtt://HOST[:PORT] or mqtts://HOST[:PORT], found 'ws://b'"));
    CHECK_THAT(
        getError(ReadCluster(R"(["mqtt://a", "mqtt://b", "mqtt://A:1883"])")),
        Catch::Contains("mqtt.urls: A:1883 is given twice"));
    CHECK_THAT(
        getError(ReadCluster(R"(["mqtts://a", "mqtt://b"])")),
        Catch::Contains("mqtt.urls: has mqtt:// and mqtts://; give one scheme"));
    CHECK_THAT(getError(ReadCluster(R"(["mqtt://a"])", {"mqtt.max_qos=3"})), Catch::Contains("mqtt.max_qos: "));
    CHECK_THAT(
        getError(ReadCluster(R"(["mqtt://a", "mqtt://b"])", {"mqtt.ca_file=" + std::string(ACS_SITE) + "/acsd.toml"})),
        Catch::Contains("mqtt.ca_file: is for mqtts:// only, and mqtt.urls is mqtt://"));
}

TEST_CASE("Topics with a '.' or a blank are a warning where nats-server may be the broker")
{
    const std::vector<std::string> dotted{"robots.LR01.serial=LR.01", "robots.CR01.manufacturer=AC ME"};
    std::vector<std::string> modest = dotted;
    modest.emplace_back("mqtt.max_qos=1");
    CHECK(ReadMQTT(dotted).warnings.empty());
    for (const AcsdConfig& config : {ReadMQTT(modest), ReadCluster(R"(["mqtt://a", "mqtt://b"])", dotted)})
    {
        REQUIRE(config.errors.empty());
        REQUIRE(config.warnings.size() == 1);
        CHECK_THAT(
            config.warnings[0],
            Catch::StartsWith("mqtt: 2 of 2 robots have topics with a '.' or a blank, such as "));
    }
    CHECK_THAT(
        ReadMQTT({"mqtt.interface_name=uagv.eu", "mqtt.max_qos=0"}).warnings.at(0),
        Catch::Contains("'uagv.eu/v2/ACS/"));
}

TEST_CASE("mqtt.username and the first line of mqtt.password_file are sent to the broker; a readable file is rejected")
{
    const Testing::TemporaryFolder folder;
    const std::string file = WriteFile(folder, "password", "s3cret word\r\nsecond line\n");
    AcsdConfig config = ReadMQTT({"mqtt.username=acs", "mqtt.password_file=" + file});
    REQUIRE(config.errors.empty());
    CHECK(config.warnings.empty());
    Testing::SeededRandom random{1};
    const VDA5050::MosquittoOptions options = MakeMqttOptions(config.mqtt.value(), random);
    CHECK(options.username == "acs");
    CHECK(options.password == "s3cret word");
    for (const auto& [key, value] : config.values) // which are logged when they change
    {
        CHECK(value.find("s3cret") == std::string::npos);
    }

    std::filesystem::permissions(file, std::filesystem::perms::others_read, std::filesystem::perm_options::add);
    config = ReadMQTT({"mqtt.username=acs", "mqtt.password_file=" + file});
    REQUIRE(config.errors.size() == 1);
    CHECK(
        config.errors[0].find("mqtt.password_file: every user of this machine can read " + file + "; run chmod o-rwx")
        != std::string::npos);
}

TEST_CASE("A password over mqtt://, or headers over ws://, to another machine cause a warning without the value")
{
    const Testing::TemporaryFolder folder;
    const std::string password = "mqtt.password_file=" + WriteFile(folder, "password", "s3cret");
    const auto warn = [](const std::vector<std::string>& overrides) {
        return ReadMQTT(overrides).warnings;
    };
    for (const char* host : {"127.0.0.1", "localhost", "[::1]"})
    {
        INFO(host);
        const std::string url = std::string("mqtt.url=mqtt://") + host + ":1883";
        CHECK(warn({"mqtt.username=acs", password, url}).empty());
    }
    CHECK(warn({"mqtt.url=mqtt://10.0.0.5:1883"}).empty());
    CHECK(
        warn({"mqtt.username=acs", password, "mqtt.url=mqtt://10.0.0.5:1883"})
        == std::vector<std::string>{"mqtt.password_file: it is sent to 10.0.0.5 unencrypted; use mqtts://"});
    CHECK(warn({"mqtt.username=acs", password, "mqtt.url=mqtts://10.0.0.5:8883"}).empty());
}

TEST_CASE("A password file that is missing, empty or without a name is an error with its key")
{
    const Testing::TemporaryFolder folder;
    const std::string empty = WriteFile(folder, "empty", "\n");
    const std::string good = WriteFile(folder, "good", "x\n");
    const auto getError = [](const std::vector<std::string>& overrides) {
        const std::vector<std::string> errors = ReadMQTT(overrides).errors;
        REQUIRE(errors.size() == 1);
        return errors[0];
    };
    CHECK_THAT(
        getError({"mqtt.username=acs", "mqtt.password_file=/nowhere/password"}),
        Catch::Contains("mqtt.password_file: /nowhere/password cannot be read (No such file or directory)"));
    CHECK_THAT(
        getError({"mqtt.username=acs", "mqtt.password_file=" + empty}),
        Catch::Contains("mqtt.password_file: " + empty + " has no password in its first line"));
    CHECK_THAT(getError({"mqtt.password_file=" + good}), Catch::Contains("mqtt.password_file: needs mqtt.username"));
}

TEST_CASE("With mqtts the files of CA, certificate and key must exist; with mqtt they are an error")
{
    const Testing::TemporaryFolder folder;
    Testing::CertificateMaker maker(folder.GetPath());
    const Testing::CertificateFiles ca = maker.MakeCA("ca");
    const Testing::CertificateFiles own = maker.Make(ca, {});
    const std::vector<std::string> files{
        "mqtt.ca_file=" + ca.certificate,
        "mqtt.cert_file=" + own.certificate,
        "mqtt.key_file=" + own.key};
    const auto with = [&files](const std::string& url, std::size_t count) {
        std::vector<std::string> overrides{"mqtt.url=" + url};
        overrides.insert(overrides.end(), files.begin(), files.begin() + static_cast<std::ptrdiff_t>(count));
        return ReadMQTT(overrides);
    };
    Testing::SeededRandom random{1};
    const AcsdConfig config = with("mqtts://broker:8883", 3);
    REQUIRE(config.errors.empty());
    const VDA5050::MosquittoOptions options = MakeMqttOptions(config.mqtt.value(), random);
    REQUIRE(options.tls.has_value());
    CHECK(options.tls->caFile == ca.certificate);
    CHECK(options.tls->certFile == own.certificate);
    CHECK(options.tls->keyFile == own.key);
    CHECK(MakeMqttOptions(with("mqtts://broker:8883", 0).mqtt.value(), random).tls.has_value());

    const auto plain = with("mqtt://broker:1883", 1).errors;
    REQUIRE(plain.size() == 1);
    CHECK_THAT(plain[0], Catch::Contains("mqtt.ca_file: is for mqtts:// only"));
    const auto half = with("mqtts://broker:8883", 2).errors;
    REQUIRE(half.size() == 1);
    CHECK_THAT(half[0], Catch::Contains("mqtt.cert_file: needs the other one too"));
    const auto wrong =
        ReadMQTT({"mqtt.url=mqtts://broker:8883", "mqtt.ca_file=" + WriteFile(folder, "text", "no PEM\n")}).errors;
    REQUIRE(wrong.size() == 1);
    CHECK_THAT(wrong[0], Catch::Contains("mqtt.ca_file: "));
    const AcsdConfig relative = ReadMQTT({"mqtt.url=mqtts://broker:8883", "mqtt.ca_file=nowhere.pem"});
    CHECK(relative.mqtt.value().tls.caFile == std::string(ACS_SITE) + "/nowhere.pem");
}

} // namespace ACS::Acsd::Test
