#include "apps/os/tls/certificates.h"

#include <gtest/gtest.h>

#include "anatomy/base/error.h"
#include "anatomy/base/whole_file.h"
#include "apps/os/file_access.h"
#include "apps/os/tls/kept_identity.h"
#include "tests/support/scratch_folder.h"
#include "tests/tls/room.h"

namespace palpa::os {
namespace {

using std::chrono::days;
using std::chrono::sys_seconds;

IdentityWish console() {
  return {.name = "Palpa console", .reached_by = {"station3.local", "192.168.1.20", "::1"}};
}

TEST(Certificates, SayWhoTheyAreOfAndForHowLong) {
  const Identity made = makeIdentity(console(), authority(), kNow);
  const CertificateFacts facts = factsOf(made.certificate, "made");
  EXPECT_EQ(facts.name, "Palpa console");
  EXPECT_EQ(facts.issuer, "Authority of a room");
  EXPECT_EQ(facts.reached_by, (std::vector<std::string>{"192.168.1.20", "::1", "station3.local"}));
  EXPECT_EQ(facts.until, kNow + days{397});
  EXPECT_LT(facts.from, kNow);
  EXPECT_EQ(facts.fingerprint.size(), 32u * 3 - 1);
  EXPECT_NE(facts.fingerprint,
            factsOf(makeIdentity(console(), authority(), kNow).certificate, "").fingerprint);
}

TEST(Certificates, AreVouchedForByTheirOwnAuthorityWhileTheyLast) {
  const Identity made = makeIdentity(console(), authority(), kNow);
  const Identity stranger = makeAuthority("Authority of a room", {}, days{3650}, kNow);
  EXPECT_TRUE(isVouchedFor(made.certificate, authority().certificate, kNow));
  EXPECT_TRUE(isVouchedFor(made.certificate, authority().certificate, kNow + days{396}));
  EXPECT_FALSE(isVouchedFor(made.certificate, authority().certificate, kNow + days{398}));
  EXPECT_FALSE(isVouchedFor(made.certificate, authority().certificate, kNow - days{2}));
  EXPECT_FALSE(isVouchedFor(made.certificate, stranger.certificate, kNow));
  EXPECT_FALSE(isVouchedFor("", authority().certificate, kNow));
}

/// What a certificate names may vouch for nobody.
TEST(Certificates, NobodyButTheAuthorityVouches) {
  const Identity made = makeIdentity(console(), authority(), kNow);
  const Identity forged = makeIdentity(console(), made, kNow);
  EXPECT_FALSE(isVouchedFor(forged.certificate, authority().certificate, kNow));
  EXPECT_FALSE(isVouchedFor(forged.certificate, made.certificate, kNow));
}

/// So that a stolen key opens no bank.
TEST(Certificates, AnAuthorityVouchesWithinItsHouseAlone) {
  const Identity of_names =
      makeAuthority("Authority", {"station3.centre.org", "131.152.1.7"}, days{3650}, kNow);
  const auto vouches = [](const Identity& by, const std::string& name) {
    const Identity made = makeIdentity({.name = "a", .reached_by = {name}}, by, kNow);
    return isVouchedFor(made.certificate, by.certificate, kNow);
  };
  for (const char* name : {"localhost", "station3.local", "127.0.0.1", "10.1.2.3", "172.20.0.1",
                           "192.168.1.20", "169.254.7.7", "::1", "fd00::7", "fe80::1"})
    EXPECT_TRUE(vouches(authority(), name)) << name;
  for (const char* name : {"bank.example", "local.example", "131.152.1.7", "172.32.0.1",
                           "2001:db8::1", "::2", "station3.centre.org"})
    EXPECT_FALSE(vouches(authority(), name)) << name;
  EXPECT_TRUE(vouches(of_names, "station3.centre.org"));
  EXPECT_TRUE(vouches(of_names, "131.152.1.7"));
  EXPECT_FALSE(vouches(of_names, "station4.centre.org"));
  EXPECT_FALSE(vouches(of_names, "131.152.1.8"));
}

TEST(Certificates, NamesHaveOneForm) {
  EXPECT_EQ(usualForm("Station3.LOCAL"), "station3.local");
  EXPECT_EQ(usualForm("FD00:0:0::1"), "fd00::1");
  EXPECT_EQ(usualForm("192.168.1.20"), "192.168.1.20");
  EXPECT_THROW(usualForm("a,b"), UsageError);
}

TEST(Certificates, AKeyBelongsToOne) {
  const Identity one = makeIdentity(console(), authority(), kNow),
                 other = makeIdentity(console(), authority(), kNow);
  EXPECT_TRUE(belongTogether(one));
  EXPECT_FALSE(belongTogether({one.certificate, other.key}));
  EXPECT_FALSE(belongTogether({one.key, one.certificate}));
  EXPECT_FALSE(belongTogether({"", ""}));
}

TEST(Certificates, NamesThatWouldBecomeOthersAreRefused) {
  for (const char* name : {"", "a,DNS:bank.example", "a\nb", "a b", "*", "b\xC3\xBCro"}) {
    IdentityWish wish = console();
    wish.reached_by = {name};
    EXPECT_THROW(makeIdentity(wish, authority(), kNow), UsageError) << name;
  }
  IdentityWish wish = console();
  wish.name = std::string(65, 'a');
  EXPECT_THROW(makeIdentity(wish, authority(), kNow), UsageError);
}

TEST(Certificates, WhatIsNoneIsSaidToBeNone) {
  for (const std::string& text : {std::string(), std::string("-----BEGIN CERTIFICATE-----\nAAAA"),
                                  authority().key, std::string(100'000, 'A')}) {
    EXPECT_THROW(factsOf(text, "station.pem"), UsageError);
    EXPECT_FALSE(isVouchedFor(text, authority().certificate, kNow));
  }
}

struct Kept {
  test::ScratchFolder folder{"kept_identity"};
  std::string own(const IdentityWish& wish, sys_seconds now) {
    return factsOf(keptIdentity(folder.path(), wish, now).identity.certificate, "").fingerprint;
  }
  std::string authority() const {
    return factsOf(readWhole(folder / "authority.pem").value(), "").fingerprint;
  }
};

TEST(KeptIdentity, IsTheSameUntilAMonthBeforeItsEndAndItsAuthorityForYears) {
  Kept kept;
  const std::string first = kept.own(console(), kNow), authority = kept.authority();
  EXPECT_EQ(kept.own(console(), kNow + days{366}), first);
  const std::string second = kept.own(console(), kNow + days{368});
  EXPECT_NE(second, first);
  EXPECT_EQ(kept.own(console(), kNow + days{700}), second);
  EXPECT_EQ(kept.authority(), authority);
  kept.own(console(), kNow + days{3300});
  EXPECT_NE(kept.authority(), authority) << "it would end before what it vouches for";
}

TEST(KeptIdentity, FollowsTheNamesAndWhatWasDamaged) {
  Kept kept;
  const std::string first = kept.own(console(), kNow), authority = kept.authority();
  IdentityWish wish = console();
  wish.reached_by = {"Station3.local", "0:0:0:0:0:0:0:1", "192.168.1.20"};
  EXPECT_EQ(kept.own(wish, kNow), first) << "the same names otherwise written";
  wish.reached_by.push_back("10.0.0.7");
  const std::string named = kept.own(wish, kNow);
  EXPECT_NE(named, first);
  for (const char* file : {"own.pem", "own.key"}) {
    writeWhole(kept.folder / file, "half of a f");
    const std::string again = kept.own(wish, kNow);
    EXPECT_EQ(kept.own(wish, kNow), again);
    EXPECT_EQ(kept.authority(), authority);
  }
  writeWhole(kept.folder / "authority.key", "");
  kept.own(wish, kNow);
  const std::string second = kept.authority();
  EXPECT_NE(second, authority);
  wish.reached_by.push_back("station3.centre.org");  // beyond its house
  EXPECT_TRUE(keptIdentity(kept.folder.path(), wish, kNow).is_new);
  EXPECT_FALSE(keptIdentity(kept.folder.path(), wish, kNow).is_new);
  EXPECT_NE(kept.authority(), second);
}

TEST(KeptIdentity, ANameThatIsNoneLeavesNothing) {
  Kept kept;
  IdentityWish wish = console();
  wish.reached_by = {"b\xC3\xBCro"};
  EXPECT_THROW(kept.own(wish, kNow), UsageError);
  EXPECT_TRUE(std::filesystem::is_empty(kept.folder.path()));
}

TEST(KeptIdentity, ItsKeysAreForTheirOwnerAlone) {
  Kept kept;
  kept.own(console(), kNow);
  EXPECT_EQ(privacyOf(kept.folder / "own.key"), Privacy::own);
  EXPECT_EQ(privacyOf(kept.folder / "authority.key"), Privacy::own);
}

TEST(IdentityInFiles, IsAPairThatLastsStill) {
  const test::ScratchFolder folder("identity_in_files");
  const Identity made = makeIdentity(console(), authority(), kNow);
  writeWhole(folder / "a.pem", made.certificate);
  writeWhole(folder / "a.key", made.key, Lasts::no, Readers::owner);
  writeWhole(folder / "b.key", authority().key, Lasts::no, Readers::owner);
  writeWhole(folder / "open.key", made.key);
  EXPECT_EQ(identityIn(folder / "a.pem", folder / "a.key", kNow).key, made.key);
  EXPECT_THROW(identityIn(folder / "a.pem", folder / "b.key", kNow), UsageError);
  EXPECT_THROW(identityIn(folder / "a.pem", folder / "none", kNow), UsageError);
  EXPECT_THROW(identityIn(folder / "a.pem", folder / "open.key", kNow), UsageError);
  EXPECT_THROW(identityIn(folder / "a.key", folder / "a.key", kNow), UsageError);
  EXPECT_THROW(identityIn(folder / "a.pem", folder / "a.key", kNow + days{397}), UsageError);
}

}  // namespace
}  // namespace palpa::os
