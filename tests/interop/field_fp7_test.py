"""The simulated FP7 of tests/field itself: the vectors of the protocol's notes, its limits, and what is no frame."""

import random

from foreign_fp7 import ForeignFp7Test, RawMaster, bcc
from mewtocol_vectors import COM
from support import main

SILENT = 0.15     # seconds without an answer that are enough to say that there is none
NOT_OFFERED = {"V29", "V31", "V42", "V48", "M11"}  # SC, SD, MC, MD, MG, a command in several frames
INPUTS_AND_TIMERS = [
    ("V02", [("%01#RCSX000A6C", "%01$RC120")]),
    ("V04", [("%01#RCST009911", "%01$RC120")]),
    ("V05", [("%01#RCP4Y0001R0001Y0003T009977", "%01$RC101110")])]
RT, RT_ANSWER = "%01#RT01", "%01$RT000000010000000007"


def checked(text):
    return text + bcc(text)


class FieldFp7Test(ForeignFp7Test):
    def start(self, *options, number=1):
        self.start_fp7(*options, number=number)
        return RawMaster(self)

    def exchange(self, master, number, exchanges):
        for request, answer in exchanges:
            with self.subTest(vector=number, request=request):
                heard = master.ask(request, SILENT if answer == "" else 5)
                if answer is not None:
                    self.assertEqual(heard, answer)

    def test_vectors(self):
        master = self.start()
        rows = [row for row in COM if row[0] not in NOT_OFFERED]
        for number, memory, exchanges in rows:
            for zeros in ("DD0000000099" + "0000" * 100, "CCY00000009" + "0000" * 10, "CCR00000009" + "0000" * 10):
                self.assertEqual(master.ask(f"<01#W{zeros}**")[3:6], "$W" + zeros[0])
            for device, values in memory.items():
                command, digits = {"DT": ("WDD", 5), "WY": ("WCCY", 4)}[device[:2]]
                first, last = int(device[2:]), int(device[2:]) + len(values) - 1
                words = "".join(each.to_bytes(2, "little").hex().upper() for each in values)
                self.assertNotIn("!", master.ask(f"<01#{command}{first:0{digits}}{last:0{digits}}{words}**"))
            self.exchange(master, number, exchanges)
        self.assertGreater(len(rows), 40)

    def test_vectors_with_inputs_and_timers(self):
        master = self.start("--set", "X000A=1", "Y1=1", "Y3=1", "T99=1")
        for number, exchanges in INPUTS_AND_TIMERS:
            self.exchange(master, number, exchanges)

    def test_its_number_is_decimal(self):
        master = self.start("--set", "DT0=5", number=12)
        self.assertEqual(master.ask("%12#RDD000000000057"), "%12$RD050011")
        self.assertEqual(master.ask("%0C#RT**", SILENT), "")

    def test_limits(self):
        master = self.start("--set", "DT65535=7")
        self.assertEqual(master.ask("%01#RDD6553565535**"), checked("%01$RD0700"))
        self.assertEqual(master.ask("%01#RDD6553565536**"), checked("%01!61"))
        self.assertEqual(len(master.ask("<01#RDD0000000508**")), 2045 - 1)
        self.assertEqual(master.ask("<01#RDD0000000509**"), checked("<01!43"))
        for header, words in (("%", 24), ("<", 507)):
            text = f"{header}01#WDD00000{words - 1:05}" + "0100" * words
            self.assertEqual(master.ask(checked(text)), checked(f"{header}01$WD"))
            longest = 117 if header == "%" else 2047
            self.assertEqual(master.ask(f"{header}01#" + "R" * (longest - 4)), checked(f"{header}01!40"))
            self.assertEqual(master.ask(f"{header}01#" + "R" * (longest - 3)), checked(f"{header}01!27"))
        for area, last in (("X", 511), ("Y", 511), ("R", 2047), ("L", 1023)):
            self.assertEqual(master.ask(f"%01#RCC{area}{last:04}{last:04}**"), checked("%01$RC0000"))
            self.assertEqual(master.ask(f"%01#RCC{area}{last + 1:04}{last + 1:04}**"), checked("%01!61"))

    def test_a_refused_write_changes_nothing(self):
        master = self.start()
        for refused, code in (("WCP2R00001X00011", "60"), ("WCP2R00001R00G11", "61"), ("WCP2R00001R00012", "61"),
                              ("WDD00000000010100", "41"), ("WDD00000000010100020G", "61"), ("WCCR000000010100", "41"),
                              ("WDD65535655360100FF00", "61"), ("SDD00000000010100", "42")):
            self.assertEqual(master.ask(f"%01#{refused}**"), checked(f"%01!{code}"), refused)
        self.assertEqual(master.ask("%01#RCCR00000001**"), checked("%01$RC00000000"))
        self.assertEqual(master.ask("%01#RDD0000000001**"), checked("%01$RD00000000"))

    def test_what_stands_in_front_of_a_frame_is_not_in_it(self):
        master = self.start()
        for noise in ("", "\x00\xff$!#&", "%01#RD", "%01#RDD00", "<01#", "\r\r"):
            self.assertEqual(master.ask(noise + RT), RT_ANSWER, noise)

    def test_nothing_kills_it(self):
        """Damaged commands and bare noise: each answer is a frame, and it still answers what is right."""
        master = self.start()
        choose = random.Random(4)
        seeds = [checked(f"{header}01#{text}") for header in "%<"
                 for text in ("RDD0000000005", "WDD00000000010100FFFF", "RCSR0001", "WCSR00011", "RCP2R0000T0001",
                              "WCP2R00001Y00010", "RCCX00000002", "WCCR000000013412FFFF", "RT", "AB")]
        for turn in range(200):
            frame = list(choose.choice(seeds))
            for _ in range(choose.randrange(1, 4)):
                at = choose.randrange(len(frame))
                new = chr(choose.choice([choose.randrange(256), *b"0123456789ABCDEF%<#&*!$\r"]))
                frame[at:at + choose.randrange(2)] = [new] * choose.choice((1, 1, 1, 200))
            if choose.random() < 0.5:
                frame[-2:] = "**"
            damaged = "".join(frame)
            heard = master.ask(damaged + "\r%01#AB**\r" + RT)  # AB: nothing waits
            while heard != RT_ANSWER:
                text = heard.removesuffix("&")
                self.assertEqual(bcc(text[:-2]), text[-2:], f"turn {turn}: {heard!r} to {damaged!r}")
                heard = master.hear(5)
                self.assertTrue(heard, f"turn {turn}: it does not answer after {damaged!r}")
        self.assertTrue(self.fp7.running())


main()
