#include "CertificateMaker.hpp"

#include <openssl/bio.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rsa.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <utility>

namespace ACS::Testing
{

namespace
{

struct Release
{
    void operator()(EVP_PKEY* key) const
    {
        EVP_PKEY_free(key);
    }
    void operator()(X509* certificate) const
    {
        X509_free(certificate);
    }
    void operator()(X509_EXTENSION* extension) const
    {
        X509_EXTENSION_free(extension);
    }
    void operator()(BIO* file) const
    {
        BIO_free(file);
    }
};

using Key = std::unique_ptr<EVP_PKEY, Release>;
using Certificate = std::unique_ptr<X509, Release>;
using File = std::unique_ptr<BIO, Release>;

constexpr unsigned RSA_BITS = 2048;

/// A test cannot continue without its certificates.
void Need(bool bDone, const std::string& what)
{
    if (!bDone)
    {
        throw std::runtime_error("cannot make a certificate: " + what);
    }
}

File Open(const std::string& path, const char* mode)
{
    File file(BIO_new_file(path.c_str(), mode));
    Need(file != nullptr, path);
    return file;
}

Key MakeKey(bool bRSA)
{
    Key key(bRSA ? EVP_RSA_gen(RSA_BITS) : EVP_EC_gen("P-256"));
    Need(key != nullptr, "key");
    return key;
}

void AddExtension(X509* certificateOrNull, int kind, const std::string& value)
{
    X509V3_CTX context{};
    X509V3_set_ctx(&context, certificateOrNull, certificateOrNull, nullptr, nullptr, 0);
    const std::unique_ptr<X509_EXTENSION, Release> extension(
        X509V3_EXT_conf_nid(nullptr, &context, kind, value.c_str()));
    Need(extension != nullptr && X509_add_ext(certificateOrNull, extension.get(), -1) == 1, value);
}

/// Without issuer and signature.
Certificate MakeBlank(EVP_PKEY* keyOrNull, const std::string& name, int serial, const CertificateRequest& wish)
{
    Certificate certificate(X509_new());
    Need(certificate != nullptr, "certificate");
    X509* const handle = certificate.get();
    const auto* const text = reinterpret_cast<const unsigned char*>(name.c_str()); // the type of OpenSSL
    const auto from = std::chrono::seconds(wish.validFrom).count();
    const auto to = std::chrono::seconds(wish.validTo).count();
    const bool bDone = X509_set_version(handle, X509_VERSION_3) == 1
        && ASN1_INTEGER_set(X509_get_serialNumber(handle), serial) == 1
        && X509_gmtime_adj(X509_getm_notBefore(handle), from) != nullptr
        && X509_gmtime_adj(X509_getm_notAfter(handle), to) != nullptr && X509_set_pubkey(handle, keyOrNull) == 1
        && X509_NAME_add_entry_by_NID(X509_get_subject_name(handle), NID_commonName, MBSTRING_UTF8, text, -1, -1, 0)
            == 1;
    Need(bDone, name);
    return certificate;
}

void Sign(X509* certificateOrNull, const X509* issuerOrNull, EVP_PKEY* issuerKeyOrNull)
{
    Need(
        X509_set_issuer_name(certificateOrNull, X509_get_subject_name(issuerOrNull)) == 1
            && X509_sign(certificateOrNull, issuerKeyOrNull, EVP_sha256()) > 0,
        "signature");
}

CertificateFiles Write(
    const std::filesystem::path& path,
    X509* certificateOrNull,
    EVP_PKEY* keyOrNull,
    const std::string& passphrase)
{
    CertificateFiles files{path.string() + ".pem", path.string() + ".key"};
    Need(PEM_write_bio_X509(Open(files.certificate, "w").get(), certificateOrNull) == 1, files.certificate);
    const auto* const secret = reinterpret_cast<const unsigned char*>(passphrase.data()); // the type of OpenSSL
    const bool bWritten = PEM_write_bio_PrivateKey(
                              Open(files.key, "w").get(),
                              keyOrNull,
                              passphrase.empty() ? nullptr : EVP_aes_128_cbc(),
                              passphrase.empty() ? nullptr : secret,
                              static_cast<int>(passphrase.size()),
                              nullptr,
                              nullptr)
        == 1;
    Need(bWritten, files.key);
    std::filesystem::permissions(files.key, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    return files;
}

} // namespace

CertificateMaker::CertificateMaker(std::filesystem::path folder)
    : _folder(std::move(folder))
{
}

CertificateFiles CertificateMaker::MakeCA(const std::string& name)
{
    const Key key = MakeKey(false);
    const Certificate certificate = MakeBlank(key.get(), name, ++_count, {});
    AddExtension(certificate.get(), NID_basic_constraints, "critical,CA:TRUE");
    AddExtension(certificate.get(), NID_key_usage, "critical,keyCertSign,cRLSign");
    Sign(certificate.get(), certificate.get(), key.get());
    return Write(_folder / name, certificate.get(), key.get(), {});
}

CertificateFiles CertificateMaker::Make(const CertificateFiles& ca, const CertificateRequest& wish)
{
    const Certificate issuer(PEM_read_bio_X509(Open(ca.certificate, "r").get(), nullptr, nullptr, nullptr));
    const Key issuerKey(PEM_read_bio_PrivateKey(Open(ca.key, "r").get(), nullptr, nullptr, nullptr));
    Need(issuer != nullptr && issuerKey != nullptr, ca.certificate);
    const std::string name = "peer" + std::to_string(++_count);
    const Key key = MakeKey(wish.bRSA);
    const Certificate certificate =
        MakeBlank(key.get(), wish.commonName.empty() ? name : wish.commonName, _count, wish);
    AddExtension(certificate.get(), NID_subject_alt_name, wish.alternativeName);
    Sign(certificate.get(), issuer.get(), issuerKey.get());
    return Write(_folder / name, certificate.get(), key.get(), wish.passphrase);
}

CertificateFiles CertificateMaker::MakeSelfSigned(const CertificateRequest& wish)
{
    const std::string name = "self" + std::to_string(++_count);
    const Key key = MakeKey(wish.bRSA);
    const Certificate certificate =
        MakeBlank(key.get(), wish.commonName.empty() ? name : wish.commonName, _count, wish);
    AddExtension(certificate.get(), NID_subject_alt_name, wish.alternativeName);
    Sign(certificate.get(), certificate.get(), key.get());
    return Write(_folder / name, certificate.get(), key.get(), wish.passphrase);
}

std::string CertificateMaker::WriteFile(const std::string& name, const std::string& text) const
{
    const std::filesystem::path path = _folder / name;
    std::ofstream file(path, std::ios::binary);
    file << text;
    Need(file.good(), path.string());
    return path.string();
}

} // namespace ACS::Testing
