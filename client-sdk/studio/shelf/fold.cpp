#include "client-sdk/studio/shelf/fold.hpp"

#include <algorithm>
#include <array>

#include "server/base/utf8.hpp"

namespace mechane::studio {
namespace {

struct Letter {
  char32_t plain;
  std::u32string_view others;
};
// clang-format off
constexpr std::array kLetters{
    Letter{U'a', U"ÀÁÂÃÄÅàáâãäåĀāĂăĄą"},
    Letter{U'c', U"ÇçĆćĈĉĊċČč"},
    Letter{U'd', U"Ďď"},
    Letter{U'e', U"ÈÉÊËèéêëĒēĔĕĖėĘęĚě"},
    Letter{U'g', U"ĜĝĞğĠġĢģ"},
    Letter{U'h', U"Ĥĥ"},
    Letter{U'i', U"ÌÍÎÏìíîïĨĩĪīĬĭĮįİ"},
    Letter{U'j', U"Ĵĵ"},
    Letter{U'k', U"Ķķ"},
    Letter{U'l', U"ĹĺĻļĽľ"},
    Letter{U'n', U"ÑñŃńŅņŇň"},
    Letter{U'o', U"ÒÓÔÕÖòóôõöŌōŎŏŐő"},
    Letter{U'r', U"ŔŕŖŗŘř"},
    Letter{U's', U"ŚśŜŝŞşŠš"},
    Letter{U't', U"ŢţŤť"},
    Letter{U'u', U"ÙÚÛÜùúûüŨũŪūŬŭŮůŰűŲų"},
    Letter{U'w', U"Ŵŵ"},
    Letter{U'y', U"ÝýÿŶŷŸ"},
    Letter{U'z', U"ŹźŻżŽž"},
    Letter{U'α', U"ΆΑάἀἁἂἃἄἅἆἇἈἉἊἋἌἍἎἏὰάᾀᾁᾂᾃᾄᾅᾆᾇᾈᾉᾊᾋᾌᾍᾎᾏᾰᾱᾲᾳᾴᾶᾷᾸᾹᾺΆᾼ"},
    Letter{U'β', U"Β"},
    Letter{U'γ', U"Γ"},
    Letter{U'δ', U"Δ"},
    Letter{U'ε', U"ΈΕέἐἑἒἓἔἕἘἙἚἛἜἝὲέῈΈ"},
    Letter{U'ζ', U"Ζ"},
    Letter{U'η', U"ΉΗήἠἡἢἣἤἥἦἧἨἩἪἫἬἭἮἯὴήᾐᾑᾒᾓᾔᾕᾖᾗᾘᾙᾚᾛᾜᾝᾞᾟῂῃῄῆῇῊΉῌ"},
    Letter{U'θ', U"Θϴ"},
    Letter{U'ι', U"ΊΐΙΪίϊἰἱἲἳἴἵἶἷἸἹἺἻἼἽἾἿὶίιῐῑῒΐῖῗῘῙῚΊ"},
    Letter{U'κ', U"Κ"},
    Letter{U'λ', U"Λ"},
    Letter{U'μ', U"Μ"},
    Letter{U'ν', U"Ν"},
    Letter{U'ξ', U"Ξ"},
    Letter{U'ο', U"ΌΟόὀὁὂὃὄὅὈὉὊὋὌὍὸόῸΌ"},
    Letter{U'π', U"Π"},
    Letter{U'ρ', U"ΡῤῥῬ"},
    Letter{U'σ', U"Σς"},
    Letter{U'τ', U"Τ"},
    Letter{U'υ', U"ΎΥΫΰϋύὐὑὒὓὔὕὖὗὙὛὝὟὺύῠῡῢΰῦῧῨῩῪΎ"},
    Letter{U'φ', U"Φ"},
    Letter{U'χ', U"Χ"},
    Letter{U'ψ', U"Ψ"},
    Letter{U'ω', U"ΏΩώὠὡὢὣὤὥὦὧὨὩὪὫὬὭὮὯὼώᾠᾡᾢᾣᾤᾥᾦᾧᾨᾩᾪᾫᾬᾭᾮᾯῲῳῴῶῷῺΏῼ"},
};
// clang-format on

struct Fold {
  char32_t letter = 0;
  char32_t plain = 0;
};
constexpr std::size_t kFoldCount = [] {
  std::size_t count = 0;
  for (const Letter& letter : kLetters)
    count += letter.others.size();
  return count;
}();
/// By letter.
constexpr std::array<Fold, kFoldCount> kFolds = [] {
  std::array<Fold, kFoldCount> folds;
  std::size_t at = 0;
  for (const Letter& letter : kLetters)
    for (const char32_t other : letter.others)
      folds[at++] = {other, letter.plain};
  std::ranges::sort(folds, {}, &Fold::letter);
  return folds;
}();

/// Of two or three bytes that are well-formed.
char32_t code_of(std::string_view letter) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(letter[i]); };
  const char32_t first = letter.size() == 2 ? byte(0) & 0x1FU : (byte(0) & 0x0FU) << 6U | (byte(1) & 0x3FU);
  return first << 6U | (byte(letter.size() - 1) & 0x3FU);
}

void append(char32_t plain, std::string& out) {
  if (plain >= 0x80) out += static_cast<char>(0xC0U | plain >> 6U);
  out += static_cast<char>(plain < 0x80 ? plain : 0x80U | (plain & 0x3FU));
}

bool is_accent(char32_t code) {
  return code >= 0x300 && code <= 0x36F;
}

}  // namespace

std::string folded(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text.substr(at));
    const std::string_view letter = length == 0 ? "?" : text.substr(at, length);
    at += std::max<std::size_t>(length, 1);
    const char32_t code = length == 2 || length == 3 ? code_of(letter) : 0;
    if (is_accent(code)) continue;
    const auto known = std::ranges::lower_bound(kFolds, code, {}, &Fold::letter);
    if (known != kFolds.end() && known->letter == code)
      append(known->plain, out);
    else
      out += letter;
  }
  return lower_case(std::move(out));
}

}  // namespace mechane::studio
